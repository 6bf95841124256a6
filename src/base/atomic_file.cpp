#include "grid_path_planner/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner {
namespace {

// A write beyond RLIMIT_FSIZE sends SIGXFSZ, which would end the process before the error is seen.
class IgnoreFileSizeSignal {
 public:
  IgnoreFileSizeSignal() { previous_ = std::signal(SIGXFSZ, SIG_IGN); }
  ~IgnoreFileSizeSignal() { std::signal(SIGXFSZ, previous_); }
  IgnoreFileSizeSignal(const IgnoreFileSizeSignal&) = delete;
  IgnoreFileSizeSignal& operator=(const IgnoreFileSizeSignal&) = delete;

 private:
  void (*previous_)(int);
};

bool writeAll(int descriptor, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t written = ::write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return ::fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: a file system without fsync
}

}  // namespace

void writeFileAtomically(const std::string& file, const std::string& content) {
  const IgnoreFileSizeSignal ignore;
  const std::string beside = file + ".tmp" + std::to_string(::getpid());
  const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0)
    throw InputError(file, std::string("cannot be written: ") + std::strerror(errno));
  const bool written = writeAll(descriptor, content);
  int error = errno;
  const bool closed = ::close(descriptor) == 0;
  if (written && !closed) error = errno;
  if (written && closed) {
    if (std::rename(beside.c_str(), file.c_str()) == 0) return;
    error = errno;
  }
  ::unlink(beside.c_str());
  throw InputError(file, std::string("cannot be written: ") + std::strerror(error));
}

}  // namespace grid_path_planner
