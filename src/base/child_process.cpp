#include "base/child_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <thread>

#include "base/child_codes.h"

namespace grid_path_planner::base {
namespace {

namespace fs = std::filesystem;

constexpr int kQuestionPeriod = 20;  // ms, between two questions to the limits
constexpr char kFolder[] = "grid_path_planner";

// Beside the library or program that this function is in, or in the package's folder there.
std::string pathOfProgram(const std::string& name) {
  Dl_info here{};
  ::dladdr(reinterpret_cast<void*>(&answerOfChild), &here);
  std::error_code ignored;
  const fs::path library = fs::canonical(here.dli_fname ? here.dli_fname : "", ignored);
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  for (const fs::path& folder :
       {library.parent_path() / kFolder, library.parent_path(), program.parent_path()})
    if (::access((folder / name).c_str(), X_OK) == 0) return (folder / name).string();
  throw InputError("the program " + name + " of this package is missing: it belongs into " +
                   (library.parent_path() / kFolder).string());
}

class SpawnSettings {
 public:
  // The program writes into `output`; signals, also those of a terminal, reach it as if it were alone.
  explicit SpawnSettings(int output) {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    sigset_t signals;
    sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes, &signals);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

class Child {
 public:
  Child(const std::string& program, const std::string& file, const ReadLimits& limits)
      : file_(file) {
    const std::string path = pathOfProgram(program);
    std::array<std::string, 5> words = {path, file, std::to_string(limits.bytesLeft()),
                                        std::to_string(std::ceil(limits.processorSeconds())),
                                        std::to_string(::getpid())};
    std::array<char*, 6> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw InputError(file, noProcess(errno));
    output_ = ends[0];
    int error = 0;
    {
      const SpawnSettings settings(ends[1]);
      error = ::posix_spawn(&process_, path.c_str(), &settings.actions, &settings.attributes,
                            arguments.data(), environ);
    }
    ::close(ends[1]);
    if (error == 0) return;
    ::close(output_);
    throw InputError(file, noProcess(error));
  }
  ~Child() {
    ::close(output_);
    if (ended_) return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // All that it writes until it closes its output. Throws InputError where a limit is reached.
  std::string read(ReadLimits& limits) const {
    std::string bytes;
    std::array<char, 1 << 16> buffer;
    while (true) {
      limits.goOn(file_);
      pollfd polled{output_, POLLIN, 0};
      if (::poll(&polled, 1, kQuestionPeriod) <= 0) continue;
      const ssize_t count = ::read(output_, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return bytes;
      limits.take(file_, 2 * static_cast<std::size_t>(count));  // while the text grows by doubling
      bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }

  // Its status, as waitpid tells it. Where someone else in this process waits for all children (or
  // ignores their ends), it is not known: -1.
  int end(const ReadLimits& limits) {
    int status = -1;
    while (true) {
      const pid_t ended = ::waitpid(process_, &status, WNOHANG);
      if (ended == 0) {
        limits.goOn(file_);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      if (ended < 0 && errno == EINTR) continue;
      ended_ = true;
      return ended == process_ ? status : -1;
    }
  }

 private:
  static std::string noProcess(int error) {
    return std::string("cannot be read: no process can be made for it: ") + std::strerror(error);
  }

  const std::string& file_;
  pid_t process_ = -1;
  int output_ = -1;
  bool ended_ = false;
};

InputError unexpectedEnd(const std::string& file, int status) {
  const std::string how = WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status)) +
                                                    " (" + ::strsignal(WTERMSIG(status)) + ")"
                                              : "with code " + std::to_string(WEXITSTATUS(status));
  return InputError(file, "cannot be read: the process that read it ended " + how);
}

}  // namespace

std::string answerOfChild(const std::string& program, const std::string& file, ReadLimits& limits) {
  Child child(program, file, limits);
  const std::string answer = child.read(limits);
  const int status = child.end(limits);
  const bool exited = WIFEXITED(status);
  if (exited && WEXITSTATUS(status) == kAnswered && !answer.empty() && answer.back() == kWhole)
    return answer.substr(0, answer.size() - 1);
  if (exited && WEXITSTATUS(status) == kRefused && !answer.empty()) throw InputError(answer);
  if (exited && WEXITSTATUS(status) == kTooLarge) throw limits.tooLarge(file);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) throw limits.tooSlow(file);
  throw unexpectedEnd(file, status);
}

}  // namespace grid_path_planner::base
