#include "grid_path_planner/base/files.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

[[noreturn]] void throwUnreadable(const std::string& file, int error) {
  throw InputError(file, std::string("cannot be read: ") + std::strerror(error));
}

bool belongsInText(char letter) {
  const auto byte = static_cast<unsigned char>(letter);
  return byte >= 0x20 || byte == '\n' || byte == '\r' || byte == '\t' || byte == '\f';
}

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

std::string readWholeFile(const std::string& file, std::size_t largest) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.value() < 0) throwUnreadable(file, errno);
  struct stat info {};
  if (::fstat(descriptor.value(), &info) == 0 && S_ISDIR(info.st_mode))
    throw InputError(file, "is a directory, expected a file");
  std::string content;
  if (S_ISREG(info.st_mode)) content.reserve(std::min<std::size_t>(info.st_size, largest));
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(descriptor.value(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throwUnreadable(file, errno);
    if (count == 0) break;
    content.append(buffer, static_cast<std::size_t>(count));
    if (content.size() > largest)
      throw InputError(file, "is larger than " + std::to_string(largest) + " bytes");
  }
  if (content.empty()) throw InputError(file, "is empty");
  return content;
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
