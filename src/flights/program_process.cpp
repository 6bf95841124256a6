#include "flights/program_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "grid_path_planner/base/errors.h"

extern char** environ;

namespace grid_path_planner::flights {

using base::InputError;

namespace {

constexpr std::size_t kLongestLine = 1u << 20;  // bytes

bool isToBeTriedAgain() {
  return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
}

struct Pipe {
  explicit Pipe(const std::string& name) {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw InputError(name, "no pipe can be made");
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  // From now on the caller's, and never waited for by reading or writing.
  int take(int index) {
    const int end = std::exchange(ends[index], -1);
    ::fcntl(end, F_SETFL, ::fcntl(end, F_GETFL) | O_NONBLOCK);
    return end;
  }

  int ends[2] = {-1, -1};
};

}  // namespace

ProgramProcess::ProgramProcess(const std::vector<std::string>& program) : name_(program.front()) {
  ::signal(SIGPIPE, SIG_IGN);  // write() reports a lost program
  Pipe down(name_), up(name_);
  std::vector<char*> arguments;
  for (const std::string& word : program) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, down.ends[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, up.ends[1], STDOUT_FILENO);
  const int error =
      ::posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw InputError(name_, std::string("cannot be started: ") + std::strerror(error));
  to_ = down.take(1);
  from_ = up.take(0);
}

ProgramProcess::~ProgramProcess() {
  ::close(to_);
  ::close(from_);
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

void ProgramProcess::await(int descriptor, short event, Deadline deadline) const {
  using std::chrono::milliseconds;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left <= milliseconds::zero()) throw InputError(name_, "has not answered in time");
    pollfd polled = {descriptor, event, 0};
    if (::poll(&polled, 1, static_cast<int>(left.count())) > 0) return;
  }
}

void ProgramProcess::send(const void* data, std::size_t size, Deadline deadline) {
  const auto* next = static_cast<const char*>(data);
  while (size > 0) {
    await(to_, POLLOUT, deadline);
    const ssize_t written = ::write(to_, next, size);
    if (written < 0 && isToBeTriedAgain()) continue;
    if (written <= 0) throw InputError(name_, "has ended");
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::string ProgramProcess::receiveLine(Deadline deadline) {
  std::size_t end;
  while ((end = received_.find('\n')) == std::string::npos) {
    if (received_.size() > kLongestLine) throw InputError(name_, "answers without end");
    await(from_, POLLIN, deadline);
    char buffer[4096];
    const ssize_t got = ::read(from_, buffer, sizeof buffer);
    if (got < 0 && isToBeTriedAgain()) continue;
    if (got <= 0) throw InputError(name_, "has ended");
    received_.append(buffer, static_cast<std::size_t>(got));
  }
  const std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

}  // namespace grid_path_planner::flights
