// writeFileAtomically of grid_path_planner/base/files.h.
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::base {
namespace {

constexpr std::size_t kLongestBeginning = 200;  // bytes of a name; file systems take 255 in all
constexpr std::size_t kRandomDigits = 16;

[[noreturn]] void throwUnwritten(const std::string& file, int error) {
  throw InputError(file, std::string("cannot be written: ") + std::strerror(error));
}

std::shared_ptr<const int> ownedDescriptor(int value) {
  return {new int(value), [](const int* descriptor) {
            ::close(*descriptor);
            delete descriptor;
          }};
}

// What the names of all temporary files of `leaf` begin with.
std::string temporaryBeginning(const std::string& leaf) {
  return "." + leaf.substr(0, kLongestBeginning) + ".tmp";
}

std::string temporaryName(const std::string& leaf) {
  unsigned char bytes[kRandomDigits / 2];
  if (::getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
    throw InputError(leaf, "cannot be written: no random name for it");
  std::string name = temporaryBeginning(leaf);
  for (const unsigned char byte : bytes) {
    name += "0123456789abcdef"[byte / 16];
    name += "0123456789abcdef"[byte % 16];
  }
  return name;
}

bool isTemporary(const std::string& name, const std::string& beginning) {
  return name.size() == beginning.size() + kRandomDigits &&
         name.compare(0, beginning.size(), beginning) == 0 &&
         name.find_first_not_of("0123456789abcdef", beginning.size()) == std::string::npos;
}

// Removes a temporary file that nobody holds the lock of: its writer is gone.
void removeIfLeft(int folder, const char* name) {
  const int opened = ::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return;
  if (::flock(opened, LOCK_EX | LOCK_NB) == 0) ::unlinkat(folder, name, 0);
  ::close(opened);
}

void removeLeftOvers(int folder, const std::string& leaf) {
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* entries = again < 0 ? nullptr : ::fdopendir(again);
  if (!entries) {
    if (again >= 0) ::close(again);
    return;  // a folder that may be written and not be listed
  }
  const std::string beginning = temporaryBeginning(leaf);
  while (const dirent* entry = ::readdir(entries))
    if (isTemporary(entry->d_name, beginning)) removeIfLeft(folder, entry->d_name);
  ::closedir(entries);
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

// Not every file system can; the file is there all the same.
void syncFolder(int folder) {
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (again < 0) return;
  ::fsync(again);
  ::close(again);
}

// An owner that already is the right one needs no right to change it.
bool giveModeAndOwner(int descriptor, const struct stat& old) {
  struct stat now {};
  if (::fstat(descriptor, &now) != 0) return false;
  if ((now.st_uid != old.st_uid || now.st_gid != old.st_gid) &&
      ::fchown(descriptor, old.st_uid, old.st_gid) != 0)
    return false;
  return ::fchmod(descriptor, old.st_mode & 07777) == 0;
}

}  // namespace

OutputFile::OutputFile(std::string name, int folder, std::string leaf)
    : name_(std::move(name)),
      folder_(ownedDescriptor(::fcntl(folder, F_DUPFD_CLOEXEC, 0))),
      leaf_(std::move(leaf)) {}

OutputFile OutputFile::beside(const std::string& leaf) const {
  OutputFile other = *this;
  other.name_ = (std::filesystem::path(name_).parent_path() / leaf).string();
  other.leaf_ = leaf;
  return other;
}

// One writing of one file: its folder, the temporary file in it, the old file.
class AtomicWriting {
 public:
  explicit AtomicWriting(const OutputFile& file)
      : name_(file.name_), folder_(file.folder_), leaf_(file.leaf_) {
    if (!folder_) openFolder();
    lookAtOldFile();
  }
  ~AtomicWriting() {
    if (!temporary_.empty()) ::unlinkat(*folder_, temporary_.c_str(), 0);
    if (opened_ >= 0) ::close(opened_);
  }
  AtomicWriting(const AtomicWriting&) = delete;
  AtomicWriting& operator=(const AtomicWriting&) = delete;

  void write(const std::string& content) {
    removeLeftOvers(*folder_, leaf_);
    while (!openTemporary()) continue;
    if (old_ && !giveModeAndOwner(opened_, *old_)) throwUnwritten(name_, errno);
    if (!writeAll(opened_, content)) throwUnwritten(name_, errno);
    if (::renameat(*folder_, temporary_.c_str(), *folder_, leaf_.c_str()) != 0)
      throwUnwritten(name_, errno);
    temporary_.clear();
    syncFolder(*folder_);
  }

 private:
  // Of the file that a link leads to, or of the file itself.
  void openFolder() {
    std::error_code none;
    const std::filesystem::path behind = std::filesystem::canonical(name_, none);
    const std::filesystem::path file = none ? std::filesystem::path(name_) : behind;
    leaf_ = file.filename().string();
    const std::string parent = file.parent_path().empty() ? "." : file.parent_path().string();
    const int folder = ::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) throwUnwritten(name_, errno);
    folder_ = ownedDescriptor(folder);
  }

  void lookAtOldFile() {
    struct stat info {};
    if (::fstatat(*folder_, leaf_.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
      if (errno != ENOENT) throwUnwritten(name_, errno);
      return;
    }
    if (S_ISDIR(info.st_mode)) throwUnwritten(name_, EISDIR);
    if (!S_ISREG(info.st_mode)) throw InputError(name_, "cannot be written: is no regular file");
    if (::faccessat(*folder_, leaf_.c_str(), W_OK, 0) != 0) throwUnwritten(name_, errno);
    old_ = info;
  }

  // Whether it is there, with its lock: another writer may have taken it for a left-over before.
  bool openTemporary() {
    if (opened_ >= 0) ::close(opened_);
    temporary_ = temporaryName(leaf_);
    opened_ = ::openat(*folder_, temporary_.c_str(),
                       O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, old_ ? 0600 : 0644);
    if (opened_ < 0) {
      const int error = errno;
      temporary_.clear();
      throwUnwritten(name_, error);
    }
    struct stat info {};
    ::flock(opened_, LOCK_EX);
    return ::fstat(opened_, &info) == 0 && info.st_nlink > 0;
  }

  std::string name_;
  std::shared_ptr<const int> folder_;
  std::string leaf_;
  std::string temporary_;  // "": none
  int opened_ = -1;
  std::optional<struct stat> old_;
};

void writeFileAtomically(const OutputFile& file, const std::string& content) {
  const HoldFileSizeSignal hold;
  AtomicWriting(file).write(content);
}

}  // namespace grid_path_planner::base
