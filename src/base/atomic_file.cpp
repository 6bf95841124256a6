#include "grid_path_planner/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/file_size_signal.h"

namespace grid_path_planner {
namespace {

// A name that no other thread or process writes to.
std::string nameBeside(const std::string& file) {
  static std::atomic<unsigned> count{0};
  return file + ".tmp" + std::to_string(::getpid()) + "_" + std::to_string(count++);
}

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
  const HoldFileSizeSignal hold;
  const std::string beside = nameBeside(file);
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
