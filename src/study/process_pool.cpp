#include "grid_path_planner/study/process_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::study {

using base::InputError;

namespace {

// Precedes the text of an answer.
struct AnswerHead {
  std::uint64_t size = 0;
  std::uint8_t failed = 0;
};

bool writeAll(int descriptor, const void* data, std::size_t size) {
  const auto* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, next, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    next += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool readAll(int descriptor, void* data, std::size_t size) {
  auto* next = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = ::read(descriptor, next, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    next += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// The loop of a child, until its parent closes the pipe.
void serve(int from_parent, int to_parent, const ProcessPool::Work& work) {
  std::uint64_t task = 0;
  while (readAll(from_parent, &task, sizeof task)) {
    AnswerHead head;
    std::string text;
    try {
      text = work(task);
    } catch (const std::exception& error) {
      text = error.what();
      head.failed = 1;
    }
    head.size = text.size();
    if (!writeAll(to_parent, &head, sizeof head) || !writeAll(to_parent, text.data(), text.size()))
      return;
  }
}

InputError noProcess(const std::string& what) {
  return InputError("cannot " + what + " for a worker: " + std::strerror(errno));
}

std::string howItEnded(int status) {
  if (WIFSIGNALED(status))
    return std::string("its worker was ended by signal ") + std::to_string(WTERMSIG(status)) +
           " (" + strsignal(WTERMSIG(status)) + ")";
  return "its worker ended with code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

ProcessPool::ProcessPool(std::size_t processes, Work work) : work_(std::move(work)) {
  ::signal(SIGPIPE, SIG_IGN);  // write() reports a lost child
  for (std::size_t i = 0; i < processes; ++i) children_.push_back(makeChild());
}

ProcessPool::~ProcessPool() {
  for (Child& child : children_) {
    ::close(child.to);
    ::close(child.from);
    ::kill(child.process, SIGKILL);
    ::waitpid(child.process, nullptr, 0);
  }
}

ProcessPool::Child ProcessPool::makeChild() const {
  int down[2], up[2];
  if (::pipe2(down, O_CLOEXEC) != 0) throw noProcess("make a pipe");
  if (::pipe2(up, O_CLOEXEC) != 0) {
    const InputError error = noProcess("make a pipe");
    ::close(down[0]);
    ::close(down[1]);
    throw error;
  }
  const pid_t process = ::fork();
  if (process == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the parent, which ends its children
    for (const Child& other : children_) {
      ::close(other.to);
      ::close(other.from);
    }
    ::close(down[1]);
    ::close(up[0]);
    serve(down[0], up[1], work_);
    ::_exit(0);
  }
  ::close(down[0]);
  ::close(up[1]);
  if (process < 0) {
    const InputError error = noProcess("fork");
    ::close(down[1]);
    ::close(up[0]);
    throw error;
  }
  Child child;
  child.process = process;
  child.to = down[1];
  child.from = up[0];
  return child;
}

std::size_t ProcessPool::idle() const {
  return static_cast<std::size_t>(std::count_if(children_.begin(), children_.end(),
                                                [](const Child& child) { return !child.busy; }));
}

void ProcessPool::start(std::size_t task) {
  const auto child = std::find_if(children_.begin(), children_.end(),
                                  [](const Child& each) { return !each.busy; });
  assert(child != children_.end());
  child->busy = true;
  child->task = task;
  const std::uint64_t number = task;
  // A child that is gone is noticed by wait(), which finds its pipe closed.
  (void)writeAll(child->to, &number, sizeof number);
}

void ProcessPool::replace(Child& child, TaskEnd& end) {
  int status = 0;
  ::kill(child.process, SIGKILL);  // it may only have closed its pipe
  ::waitpid(child.process, &status, 0);
  ::close(child.to);
  ::close(child.from);
  end = {child.task, true, howItEnded(status)};
  child.to = child.from = -1;
  child = makeChild();
}

// Reads the available bytes; true where they complete the task.
bool ProcessPool::receive(Child& child, TaskEnd& end) {
  char buffer[1 << 16];
  const ssize_t got = ::read(child.from, buffer, sizeof buffer);
  if (got < 0 && errno == EINTR) return false;
  if (got <= 0) {
    replace(child, end);
    return true;
  }
  child.received.append(buffer, static_cast<std::size_t>(got));
  AnswerHead head;
  if (child.received.size() < sizeof head) return false;
  std::memcpy(&head, child.received.data(), sizeof head);
  if (child.received.size() < sizeof head + head.size) return false;
  end = {child.task, head.failed != 0, child.received.substr(sizeof head)};
  child.received.clear();
  child.busy = false;
  return true;
}

std::vector<TaskEnd> ProcessPool::wait(int milliseconds) {
  std::vector<pollfd> polled;
  std::vector<Child*> waited;
  for (Child& child : children_) {
    if (!child.busy) continue;
    polled.push_back({child.from, POLLIN, 0});
    waited.push_back(&child);
  }
  std::vector<TaskEnd> ends;
  if (::poll(polled.data(), polled.size(), milliseconds) <= 0) return ends;
  for (std::size_t i = 0; i < polled.size(); ++i) {
    TaskEnd end;
    if (polled[i].revents != 0 && receive(*waited[i], end)) ends.push_back(end);
  }
  return ends;
}

}  // namespace grid_path_planner::study
