#include "grid_path_planner/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

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

[[noreturn]] void throwUnwritten(const std::string& file, int error) {
  throw InputError(file, std::string("cannot be written: ") + std::strerror(error));
}

// Writes to `opened` and closes it; 0, or the error.
int contentWritten(int opened, const std::string& content) {
  const int error = writeAll(opened, content) ? 0 : errno;
  const bool closed = ::close(opened) == 0;
  return error == 0 && !closed ? errno : error;
}

// Devices and pipes cannot be replaced, and nothing in them can be lost.
void writeThrough(const std::string& file, const std::string& content) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (opened < 0) throwUnwritten(file, errno);
  const int error = contentWritten(opened, content);
  if (error != 0) throwUnwritten(file, error);
}

// The file that a link leads to, or the file itself.
std::string behindLinks(const std::string& file) {
  std::error_code none;
  const std::filesystem::path behind = std::filesystem::canonical(file, none);
  return none ? file : behind.string();
}

}  // namespace

void writeFileAtomically(const std::string& file, const std::string& content) {
  const HoldFileSizeSignal hold;
  std::error_code none;
  if (std::filesystem::is_other(std::filesystem::status(file, none)))
    return writeThrough(file, content);
  const std::string target = behindLinks(file);
  const std::string beside = nameBeside(target);
  const int opened = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (opened < 0) throwUnwritten(file, errno);
  int error = contentWritten(opened, content);
  if (error == 0 && std::rename(beside.c_str(), target.c_str()) == 0) return;
  if (error == 0) error = errno;
  ::unlink(beside.c_str());
  throwUnwritten(file, error);
}

}  // namespace grid_path_planner
