#include "grid_path_planner/base/files.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {
namespace {

[[noreturn]] void throwUnreadable(const std::string& file, int error) {
  throw InputError(file, std::string("cannot be read: ") + std::strerror(error));
}

// A device is not even opened: that alone starts some of them. What takes the file's name between
// the two questions is not waited for.
int openRegular(const std::string& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0) throwUnreadable(file, errno);
  if (S_ISDIR(info.st_mode)) throw InputError(file, "is a directory, expected a file");
  if (!S_ISREG(info.st_mode)) throw InputError(file, "is no regular file");
  const int opened = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (opened < 0) throwUnreadable(file, errno);
  return opened;
}

bool belongsInText(char letter) {
  const auto byte = static_cast<unsigned char>(letter);
  return byte >= 0x20 || byte == '\n' || byte == '\r' || byte == '\t' || byte == '\f';
}

}  // namespace

RegularFile::RegularFile(const std::string& file) : name_(file), descriptor_(openRegular(file)) {
  struct stat info {};
  const bool known = ::fstat(descriptor_, &info) == 0;
  if (known && S_ISREG(info.st_mode)) {
    size_ = static_cast<std::size_t>(info.st_size);
    return;
  }
  const int error = errno;
  ::close(descriptor_);
  if (!known) throwUnreadable(file, error);
  throw InputError(file, "is no regular file");
}

RegularFile::~RegularFile() {
  ::close(descriptor_);
}

std::string RegularFile::read(std::size_t begin, std::size_t count) const {
  std::string bytes(count, '\0');
  std::size_t done = 0;
  while (done < count) {
    const ssize_t more =
        ::pread(descriptor_, bytes.data() + done, count - done, static_cast<off_t>(begin + done));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) throwUnreadable(name_, errno);
    if (more == 0) break;
    done += static_cast<std::size_t>(more);
  }
  bytes.resize(done);
  return bytes;
}

// By the size that the file has when it is opened: one that others write to meanwhile is cut there,
// or ends early, as if it had been read before or after.
std::string readWholeFile(const std::string& file, std::size_t largest) {
  ReadOptions any;
  any.read_memory_limit = std::numeric_limits<int>::max();
  ReadLimits limits(any);
  return readWholeFile(file, largest, limits);
}

std::string readWholeFile(const std::string& file, std::size_t largest, ReadLimits& limits) {
  const RegularFile opened(file);
  limits.take(file, opened.size());
  if (opened.size() > largest)
    throw InputError(file, "is larger than " + std::to_string(largest) + " bytes");
  std::string content = opened.read(0, opened.size());
  if (content.empty()) throw InputError(file, "is empty");
  return content;
}

void dropByteOrderMark(std::string& content) {
  constexpr char kMark[] = "\xef\xbb\xbf";
  if (content.compare(0, 3, kMark) == 0) content.erase(0, 3);
}

void checkIsText(const std::string& text, const std::string& file) {
  const auto bad = std::find_if_not(text.begin(), text.end(), belongsInText);
  if (bad == text.end()) return;
  const int line = 1 + static_cast<int>(std::count(text.begin(), bad, '\n'));
  throw InputError(file, line,
                   "is not text: byte " + std::to_string(static_cast<unsigned char>(*bad)));
}

std::string withoutExtension(const std::string& file) {
  return std::filesystem::path(file).replace_extension().string();
}

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

HoldFileSizeSignal::HoldFileSizeSignal() {
  sigemptyset(&held_);
  sigaddset(&held_, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &held_, &before_);
}

HoldFileSizeSignal::~HoldFileSizeSignal() {
  const timespec at_once{};
  while (sigtimedwait(&held_, nullptr, &at_once) > 0) continue;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace grid_path_planner::base
