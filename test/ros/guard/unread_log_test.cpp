// A log that nobody read, as a pipe whose reader hangs, held every thread of a
// node that logged, for ever. Here the one who logs is a child of the test.
#include "ros/guard/outgoing/unread_log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <string>

namespace grid_path_planner::nodes {
namespace {

constexpr unsigned kDeadline = 20;  // s
constexpr int kLines = 200000;

class UnreadLog : public testing::Test {
 protected:
  UnreadLog() { EXPECT_EQ(::pipe(pipe_), 0); }
  ~UnreadLog() override {
    ::close(pipe_[0]);
    ::close(pipe_[1]);
  }

  // Whether `main` came to its end, in a child whose stdout and stderr are the pipe.
  bool ends(const std::function<void()>& main) const {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(kDeadline);
      ::dup2(pipe_[1], STDOUT_FILENO);
      ::dup2(pipe_[1], STDERR_FILENO);
      main();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  static void log(int line) { std::fprintf(line % 2 == 0 ? stdout : stderr, "line %d\n", line); }

  std::string read() const {
    ::fcntl(pipe_[0], F_SETFL, O_NONBLOCK);
    std::string text;
    char part[4096];
    for (ssize_t size = 0; (size = ::read(pipe_[0], part, sizeof(part))) > 0;)
      text.append(part, static_cast<std::size_t>(size));
    return text;
  }

  int pipe_[2] = {-1, -1};
};

TEST_F(UnreadLog, HoldsNobody) {
  EXPECT_TRUE(ends([] {
    loseUnreadLog();
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    for (int line = 0; line < kLines; ++line) log(line);
  }));
  const std::string text = read();
  EXPECT_EQ(text.substr(0, 14), "line 0\nline 1\n") << "what fits is there, in its order";
  EXPECT_EQ(text.find("line " + std::to_string(kLines - 1)), std::string::npos);
}

TEST_F(UnreadLog, IsWholeWhereItIsRead) {
  EXPECT_TRUE(ends([] {
    loseUnreadLog();
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    for (int line = 0; line < 1000; ++line) log(line);
  }));
  EXPECT_NE(read().find("line 998\nline 999\n"), std::string::npos);
}

TEST_F(UnreadLog, LeavesThoseAloneWhoShareThePipe) {
  EXPECT_TRUE(ends([] { loseUnreadLog(); }));
  EXPECT_EQ(::fcntl(pipe_[1], F_GETFL) & O_NONBLOCK, 0);
}

TEST_F(UnreadLog, LeavesFilesAlone) {
  EXPECT_TRUE(ends([] {
    const int file = ::open("/dev/null", O_WRONLY);
    ::dup2(file, STDOUT_FILENO);
    ::close(STDERR_FILENO);
    loseUnreadLog();
    ::_exit((::fcntl(STDOUT_FILENO, F_GETFL) & O_NONBLOCK) == 0 ? 0 : 1);
  }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
