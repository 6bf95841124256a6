#include "grid_path_planner/base/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner {
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

}  // namespace grid_path_planner
