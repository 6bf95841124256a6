// A program that a rostest starts, watches and ends: by its own process id, nobody else's.
//
//   Process simulator("simulator", {"_real_time_factor:=10"});     // one of this package
//   simulator.signal(SIGKILL);
//   ASSERT_TRUE(simulator.waitForExit());
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros/support/killed_node.h"
#include "ros/support/wait.h"

namespace grid_path_planner::test {

class Process {
 public:
  // An executable of this package in the devel space. Its node has its name, or that of the arguments.
  Process(const std::string& node, const std::vector<std::string>& arguments)
      : Process(joined(GPP_DEVEL "/lib/grid_path_planner/" + node, arguments)) {
    node_ = valueOf("__ns:=", "", arguments) + "/" + valueOf("__name:=", node, arguments);
  }

  // Any program, looked up in PATH; the first argument is its name.
  explicit Process(const std::vector<std::string>& command)
      : output_(testing::TempDir() + "process_output_" + std::to_string(::getpid()) + "_" +
                std::to_string(++count())) {
    std::vector<char*> arguments;
    for (const std::string& argument : command)
      arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::setenv("ROSCONSOLE_STDOUT_LINE_BUFFERED", "1", 0);  // or its INFO comes at its end
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("no process could be started");
    if (pid_ == 0) become(arguments);
  }

  ~Process() {
    end(SIGINT);
    if (killed_) killed_->forget();
    if (testing::Test::HasFailure()) std::cerr << output();
    ::unlink(output_.c_str());
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running() {
    if (!exited_ && ::wait4(pid_, &status_, WNOHANG, &used_) == pid_) exited_ = true;
    return !exited_;
  }
  void signal(int number) {
    if (!running()) return;
    if (number == SIGKILL && !node_.empty()) killed_.emplace(node_);
    ::kill(pid_, number);
  }
  pid_t pid() const { return pid_; }
  // Seconds that it has had a processor, of one that has ended all of them.
  double processorSeconds() {
    clockid_t clock{};
    timespec time{};
    if (running() && ::clock_getcpuclockid(pid_, &clock) == 0 && ::clock_gettime(clock, &time) == 0)
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    const auto seconds = [](const timeval& part) {
      return static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    };
    return seconds(used_.ru_utime) + seconds(used_.ru_stime);
  }
  // What it held at most, in bytes; 0 where it has ended.
  std::size_t peakMemory() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
    std::string word;
    while (file >> word)
      if (word == "VmHWM:" && file >> word) return std::stoul(word) * 1024;
    return 0;
  }
  bool waitForExit(std::chrono::duration<double> deadline = kDeadline) {
    return waitFor([this] { return !running(); }, deadline);
  }
  // What it has printed so far, of both streams.
  std::string output() const {
    std::ifstream file(output_);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  // Whether it prints `text`, before the deadline.
  bool says(const std::string& text) {
    return waitFor([&] { return hasSaid(text); });
  }
  // By now: for a condition that itself is waited for.
  bool hasSaid(const std::string& text) const { return output().find(text) != std::string::npos; }
  // Sends the signal and waits for the end: a law of every test is that nodes end. Returns the seconds that it took.
  double end(int number) {
    if (!running()) return 0.0;
    const auto begin = std::chrono::steady_clock::now();
    signal(number);
    const bool ended = waitForExit();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    EXPECT_TRUE(ended || node_.empty()) << "it did not end after signal " << number;
    if (ended) return taken.count();
    signal(SIGKILL);
    waitForExit();
    return taken.count();
  }
  // Of a process that exited by itself; -1 of one that was killed.
  int exitCode() const { return exited_ && WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

 private:
  // In the child. No memory is asked for: another thread may have held the allocator's lock as it was forked, and the child
  // waited for ever (seen once with the address sanitizer, of some thousand).
  [[noreturn]] void become(const std::vector<char*>& arguments) const {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind by a test that is killed
    const int file = ::open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }

  static int& count() {
    static int processes = 0;
    return processes;
  }
  static std::string valueOf(const std::string& key, std::string value,
                             const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments)
      if (argument.compare(0, key.size(), key) == 0) value = argument.substr(key.size());
    return value;
  }
  static std::vector<std::string> joined(const std::string& program,
                                         const std::vector<std::string>& arguments) {
    std::vector<std::string> command{program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
  }

  std::string output_;  // a file
  pid_t pid_;
  int status_ = 0;
  rusage used_{};  // once it has exited
  bool exited_ = false;
  std::string node_;  // its full name; empty: another program
  std::optional<KilledNode> killed_;
};

}  // namespace grid_path_planner::test
