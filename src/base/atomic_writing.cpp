// writeFileAtomically and writeFileWithPart of grid_path_planner/base/files.h.
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::base {
namespace {

constexpr std::size_t kLongestBeginning = 200;  // bytes of a name; file systems take 255 in all
constexpr std::size_t kRandomDigits = 16;
constexpr std::size_t kHashDigits = 16;
constexpr char kHexDigits[] = "0123456789abcdef";

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
    name += kHexDigits[byte / 16];
    name += kHexDigits[byte % 16];
  }
  return name;
}

bool isTemporary(const std::string& name, const std::string& beginning) {
  return name.size() == beginning.size() + kRandomDigits &&
         name.compare(0, beginning.size(), beginning) == 0 &&
         name.find_first_not_of(kHexDigits, beginning.size()) == std::string::npos;
}

// Removes a temporary file that nobody holds the lock of: its writer is gone.
void removeIfLeft(int folder, const char* name) {
  const int opened = ::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return;
  if (::flock(opened, LOCK_EX | LOCK_NB) == 0) ::unlinkat(folder, name, 0);
  ::close(opened);
}

// None for a folder that may be written and not be listed.
void forEachName(int folder, const std::function<void(const std::string&)>& use) {
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* entries = again < 0 ? nullptr : ::fdopendir(again);
  if (!entries) {
    if (again >= 0) ::close(again);
    return;
  }
  while (const dirent* entry = ::readdir(entries)) use(entry->d_name);
  ::closedir(entries);
}

void removeLeftOvers(int folder, const std::string& leaf) {
  const std::string beginning = temporaryBeginning(leaf);
  forEachName(folder, [&](const std::string& name) {
    if (isTemporary(name, beginning)) removeIfLeft(folder, name.c_str());
  });
}

// True on a file system that cannot.
bool sync(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

bool writeAll(int descriptor, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t written = ::write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return sync(descriptor);
}

// One that may be written and not be read cannot be synced.
void syncFolder(int folder, const std::string& file) {
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (again < 0) return;
  const bool synced = sync(again);
  const int error = errno;
  ::close(again);
  if (!synced)
    throw InputError(file, std::string("is written, but a loss of power may undo that: its folder "
                                       "cannot be synced: ") +
                               std::strerror(error));
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

  int folder() const { return *folder_; }
  bool replaces() const { return old_.has_value(); }

  void write(const std::string& content) {
    removeLeftOvers(*folder_, leaf_);
    while (!openTemporary()) continue;
    if (old_ && !giveModeAndOwner(opened_, *old_)) throwUnwritten(name_, errno);
    if (!writeAll(opened_, content)) throwUnwritten(name_, errno);
    if (::renameat(*folder_, temporary_.c_str(), *folder_, leaf_.c_str()) != 0)
      throwUnwritten(name_, errno);
    temporary_.clear();
    syncFolder(*folder_, name_);
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

namespace {

// 64 bits of FNV-1a in hexadecimal: against mistakes, not against forgers.
std::string hashOf(const std::string& content) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char letter : content) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 0x100000001b3u;
  }
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kHexDigits[hash >> shift & 15];
  return text;
}

// Where the hash begins in the name of a part; npos in other names.
std::size_t hashIn(const std::string& leaf) {
  const std::size_t dot = leaf.rfind('.');
  if (dot == std::string::npos || dot < kHashDigits + 1) return std::string::npos;
  const std::size_t begin = dot - kHashDigits;
  const bool all_digits = leaf.find_first_not_of(kHexDigits, begin) == dot;
  return all_digits && leaf[begin - 1] == '-' ? begin : std::string::npos;
}

std::filesystem::path placeOf(const OutputFile& file) {
  return std::filesystem::path(file.name()).parent_path();
}

// One writer of parts in a folder at a time. It is waited for, but not for ever: whoever asked for
// the file waits too.
class FolderLock {
 public:
  FolderLock(int folder, const std::string& name)
      : opened_(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    constexpr int kTries = 100;
    for (int i = 0; opened_ >= 0 && !held_ && i < kTries; ++i) {
      held_ = ::flock(opened_, LOCK_EX | LOCK_NB) == 0;
      if (!held_ && errno != EWOULDBLOCK) return;  // a file system without locks
      if (!held_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (held_ || opened_ < 0) return;
    ::close(opened_);
    throw InputError(name, "cannot be written: others are writing into its folder");
  }
  ~FolderLock() {
    if (opened_ >= 0) ::close(opened_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  bool held() const { return held_; }

 private:
  int opened_;
  bool held_ = false;
};

bool hasContent(int folder, const std::string& name) {
  struct stat info {};
  return ::fstatat(folder, name.c_str(), &info, 0) == 0 && S_ISREG(info.st_mode) &&
         info.st_size > 0;
}

// Whether a YAML file in the folder names the part: one of the same stem with another ending, or a copy.
// One that cannot be read may. Its text may quote the name in its own manner, but not the hash.
bool isNamedInFolder(const std::filesystem::path& place, int folder, const std::string& part) {
  constexpr std::size_t kLargest = 1 << 26;  // bytes; files of waypoints lie there, too
  const std::string hash = part.substr(hashIn(part));
  bool named = false;
  forEachName(folder, [&](const std::string& name) {
    const std::string extension = extensionOf(name);
    if (named || name.front() == '.' || (extension != "yaml" && extension != "yml") ||
        !hasContent(folder, name))
      return;
    try {
      named = readWholeFile((place / name).string(), kLargest).find(hash) != std::string::npos;
    } catch (const InputError&) {
      named = true;
    }
  });
  return named;
}

// What somebody has changed since is theirs.
void removeUnlessNamed(const std::filesystem::path& place, int folder, const std::string& part) {
  try {
    const std::size_t largest = std::size_t{1} << 30;
    const std::string content = readWholeFile((place / part).string(), largest);
    if (partState(part, content) == PartState::AS_WRITTEN && !isNamedInFolder(place, folder, part))
      ::unlinkat(folder, part.c_str(), 0);
  } catch (const InputError&) {
    // It is none that was written here.
  }
}

// Removes the parts of a file, but for the newest.
void removeOldParts(const OutputFile& newest, int folder, const std::string& leaf) {
  const std::string beginning = leaf.substr(0, hashIn(leaf));
  const std::filesystem::path place = placeOf(newest);
  std::vector<std::string> old;
  forEachName(folder, [&](const std::string& name) {
    if (name != leaf && name.substr(0, hashIn(name)) == beginning && hashIn(name) != leaf.npos &&
        extensionOf(name) == extensionOf(leaf))
      old.push_back(name);
  });
  for (const std::string& name : old) removeUnlessNamed(place, folder, name);
}

}  // namespace

PartState partState(const std::string& name, const std::string& content) {
  const std::string leaf = std::filesystem::path(name).filename().string();
  const std::size_t begin = hashIn(leaf);
  if (begin == std::string::npos) return PartState::NO_PART;
  return leaf.compare(begin, kHashDigits, hashOf(content)) == 0 ? PartState::AS_WRITTEN
                                                                : PartState::CHANGED;
}

OutputFile OutputFile::behindLinks() const {
  if (folder_) return *this;
  std::error_code none;
  const std::filesystem::path behind = std::filesystem::canonical(name_, none);
  return none ? *this : OutputFile(behind.string());
}

void writeFileWithPart(const OutputFile& named_file, const std::string& extension,
                       const std::string& part,
                       const std::function<std::string(const std::string& name)>& text_naming) {
  const HoldFileSizeSignal hold;
  const OutputFile file = named_file.behindLinks();
  const std::string stem = std::filesystem::path(file.name()).stem().string();
  const std::string leaf = stem.substr(0, kLongestBeginning) + "-" + hashOf(part) + "." + extension;
  const OutputFile named = file.beside(leaf);
  AtomicWriting writing(named);
  const FolderLock lock(writing.folder(), file.name());
  try {
    writing.write(part);
    writeFileAtomically(file, text_naming(leaf));
  } catch (...) {  // a disk that had room for the part alone
    if (lock.held() && !writing.replaces())
      removeUnlessNamed(placeOf(named), writing.folder(), leaf);
    throw;
  }
  if (lock.held()) removeOldParts(named, writing.folder(), leaf);
}

}  // namespace grid_path_planner::base
