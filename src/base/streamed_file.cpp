// StreamedFile of grid_path_planner/base/files.h.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::base {
namespace {

[[noreturn]] void throwNotStreamed(const std::string& file, const std::string& why) {
  throw InputError(file, "cannot be written: " + why);
}

}  // namespace

// Emptied only once it is known to be a regular file.
StreamedFile::StreamedFile(const OutputFile& file) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  descriptor_ = file.folder_
                    ? ::openat(*file.folder_, file.leaf_.c_str(), kFlags | O_NOFOLLOW, 0644)
                    : ::open(file.name_.c_str(), kFlags, 0644);
  if (descriptor_ < 0) throwNotStreamed(file.name_, std::strerror(errno));
  struct stat info {};
  const bool regular = ::fstat(descriptor_, &info) == 0 && S_ISREG(info.st_mode);
  if (regular && ::ftruncate(descriptor_, 0) == 0) return;
  const std::string why = regular ? std::strerror(errno) : "it is no regular file";
  ::close(descriptor_);
  throwNotStreamed(file.name_, why);
}

StreamedFile::~StreamedFile() {
  ::close(descriptor_);
}

std::string StreamedFile::write(const char* bytes, std::size_t count) {
  const HoldFileSizeSignal hold;
  for (std::size_t done = 0; done < count;) {
    const ssize_t more = ::write(descriptor_, bytes + done, count - done);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return std::strerror(errno);
    done += static_cast<std::size_t>(more);
  }
  return "";
}

}  // namespace grid_path_planner::base
