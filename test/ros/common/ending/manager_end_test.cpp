// A vehicle that a nodelet commanded drove on when its manager got a signal: roscpp closes the connections before
// the nodelet hears of it, and SIGTERM ends a manager at once. Here each manager is a child of the test.
#include "ros/common/ending/manager_end.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace grid_path_planner::nodes {
namespace {

constexpr int kDeadline = 20000;  // ms

// Runs `main` in a child, which writes to the test by `say`.
class Manager {
 public:
  using Say = std::function<void(char)>;

  explicit Manager(const std::function<void(const Say&)>& main) {
    if (::pipe(pipe_) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::alarm(kDeadline / 1000);
    main([this](char letter) { (void)!::write(pipe_[1], &letter, 1); });
    ::_exit(0);
  }
  ~Manager() {
    ::kill(pid_, SIGKILL);
    if (!ended_) ::waitpid(pid_, nullptr, 0);
    ::close(pipe_[0]);
    ::close(pipe_[1]);
  }

  void signal(int number) const { ::kill(pid_, number); }
  // The next letter; 0 where none comes.
  char heard() const {
    pollfd readable{pipe_[0], POLLIN, 0};
    char letter = 0;
    if (::poll(&readable, 1, kDeadline) == 1) (void)!::read(pipe_[0], &letter, 1);
    return letter;
  }
  // The signal that ended it; 0: it exited.
  int endedBy() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    ended_ = true;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  int pipe_[2] = {-1, -1};
  pid_t pid_ = -1;
  bool ended_ = false;
};

void waitForEver() {
  for (;;) ::pause();
}

TEST(ManagerEnd, AllStopBeforeTheSignalEndsTheManager) {
  for (const int number : {SIGINT, SIGTERM}) {
    Manager manager([](const Manager::Say& say) {
      const ManagerEnd one([&] { say('a'); });
      const ManagerEnd throws([] { throw std::string("nobody catches this"); });
      const ManagerEnd other([&] { say('b'); });
      say('.');
      waitForEver();
    });
    ASSERT_EQ(manager.heard(), '.');
    manager.signal(number);
    EXPECT_EQ(manager.heard(), 'a');
    EXPECT_EQ(manager.heard(), 'b');
    EXPECT_EQ(manager.endedBy(), number);
  }
}

Manager::Say says;

TEST(ManagerEnd, WhoeverHandledTheSignalBeforeGetsIt) {
  Manager manager([](const Manager::Say& say) {
    says = say;
    ::signal(SIGINT, [](int) {
      says('h');
      ::_exit(0);
    });
    const ManagerEnd end([&] { say('s'); });
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGINT);
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.heard(), 'h');
  EXPECT_EQ(manager.endedBy(), 0);
}

TEST(ManagerEnd, TheSecondSignalIsNotHeldUp) {
  Manager manager([](const Manager::Say& say) {
    const ManagerEnd end([&] {
      say('s');
      waitForEver();
    });
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGINT);
  ASSERT_EQ(manager.heard(), 's');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

TEST(ManagerEnd, OneThatIsIgnoredStaysSo) {
  Manager manager([](const Manager::Say& say) {
    ::signal(SIGINT, SIG_IGN);
    const ManagerEnd end([&] { say('s'); });
    ::raise(SIGINT);
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

TEST(ManagerEnd, SignalsAreGivenBackWithTheLast) {
  Manager manager([](const Manager::Say& say) {
    {
      const ManagerEnd end([&] { say('s'); });
    }
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

}  // namespace
}  // namespace grid_path_planner::nodes
