#include "ros/guard/file_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::OutputFile;

namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

// A name as a message shows it, however long.
std::string shown(const std::string& name) {
  constexpr std::size_t kShown = 120;
  return "'" + (name.size() <= kShown ? name : name.substr(0, kShown) + "...") + "'";
}

// The path of `file` below `folder`, both without links; none where it does not lie there. "" is
// the folder itself.
bool below(const std::string& folder, const std::string& file, std::string& rest) {
  const std::string start = folder.back() == '/' ? folder : folder + "/";
  if (file != folder && file.compare(0, start.size(), start) != 0) return false;
  rest = file == folder ? "" : file.substr(start.size());
  return true;
}

bool hasDotPart(const std::string& relative) {
  const fs::path parts(relative);
  return std::any_of(parts.begin(), parts.end(),
                     [](const fs::path& part) { return part.string().substr(0, 1) == "."; });
}

std::string endingOf(const std::string& leaf) {
  const std::size_t dot = leaf.rfind('.');
  return dot == std::string::npos ? "" : leaf.substr(dot + 1);
}

std::string listOf(const std::vector<std::string>& endings) {
  std::string text;
  for (const std::string& ending : endings) text += (text.empty() ? "." : ", .") + ending;
  return text;
}

// Where the open folder lies now.
std::string placeOf(int folder) {
  std::error_code error;
  const fs::path place = fs::read_symlink("/proc/self/fd/" + std::to_string(folder), error);
  return error ? "" : place.string();
}

// A name that is followed to a file.
class Search {
 public:
  Search(const std::string& folder, const std::string& argument, const std::string& name,
         const FileKind& kind)
      : folder_(folder), argument_(argument), name_(name), kind_(kind) {
    checkText();
    checkWritten();
    checkEnding(fs::path(name_).filename().string());
  }

  // The file's real name, `leaf` in `parent`, both without links.
  struct Found {
    Descriptor parent;
    std::string parent_path;
    std::string leaf;
    bool exists;
    std::string path() const { return (fs::path(parent_path) / leaf).string(); }
  };

  Found find() const {
    const std::string real = realRoot();
    const std::string file = behindLink((fs::path(folder_) / name_).string());
    const fs::path path(file);
    const int opened =
        ::open(path.parent_path().c_str(), O_PATH | O_DIRECTORY | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0) refuse(std::string("its folder: ") + std::strerror(errno));
    Found found{Descriptor(opened), placeOf(opened), path.filename().string(), false};
    std::string rest;
    if (found.parent_path.empty() || !below(real, found.parent_path, rest)) refuseOutside();
    if ((!rest.empty() && hasDotPart(rest)) || hasDotPart(found.leaf)) refuseDots();
    checkEnding(found.leaf);
    found.exists = isThere(found);
    return found;
  }

  // Of an existing file that is to be overwritten: one that this package could have written.
  void checkKind(const Found& found) const {
    const Descriptor file(::openat(found.parent.value(), found.leaf.c_str(),
                                   O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat info {};
    if (file.value() < 0 || ::fstat(file.value(), &info) != 0) refuse(std::strerror(errno));
    if (!S_ISREG(info.st_mode)) refuse("it is no regular file");
    std::string beginning(kFileBeginning, '\0');
    const ssize_t count = ::pread(file.value(), beginning.data(), beginning.size(), 0);
    if (count < 0) refuse(std::strerror(errno));
    beginning.resize(static_cast<std::size_t>(count));
    if (!kind_.begins || !kind_.begins(beginning))
      refuse("the file of that name is no " + kind_.name + ", and is not overwritten");
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw InputError("the " + kind_.name + " " + shown(name_) + " is refused: " + reason);
  }

 private:
  void checkText() const {
    if (name_.empty()) refuse("the name is empty");
    checkNetworkText("the name of a " + kind_.name, name_, PATH_MAX - 1);
    if (fs::path(name_).filename().string().size() > NAME_MAX) refuse("the name is too long");
  }

  // Of what is plain from the name itself nothing is asked of the disk: an answer would tell what
  // there is elsewhere.
  void checkWritten() const {
    std::string rest = name_;
    if (name_.front() == '/' && !below(folder_, name_, rest) && !below(realRoot(), name_, rest))
      refuseOutside();
    if (rest.empty() || rest.back() == '/') refuse("it names no file");
    if (hasDotPart(rest)) refuseDots();
  }

  void checkEnding(const std::string& leaf) const {
    const std::string ending = endingOf(leaf);
    if (std::find(kind_.endings.begin(), kind_.endings.end(), ending) == kind_.endings.end())
      refuse("it must end in " + listOf(kind_.endings));
  }

  std::string realRoot() const {
    std::error_code error;
    const fs::path real = fs::canonical(folder_, error);
    if (error) refuse("the folder " + folder_ + " (" + argument_ + "): " + error.message());
    return real.string();
  }

  std::string behindLink(const std::string& file) const {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(file, error))) return file;
    const fs::path behind = fs::canonical(file, error);
    if (error) refuse("it is a link that leads nowhere");
    return behind.string();
  }

  bool isThere(const Found& found) const {
    struct stat info {};
    if (::fstatat(found.parent.value(), found.leaf.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
      if (errno == ENOENT) return false;
      refuse(std::strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) refuse("it is no regular file");
    return true;
  }

  [[noreturn]] void refuseOutside() const {
    refuse("it does not lie below " + folder_ + " (" + argument_ + ")");
  }
  [[noreturn]] void refuseDots() const { refuse("a part of it begins with a dot"); }

  const std::string& folder_;
  const std::string& argument_;
  const std::string& name_;
  const FileKind& kind_;
};

}  // namespace

FileFolder::FileFolder(const std::string& path, std::string argument)
    : path_(fs::absolute(path).lexically_normal().string()), argument_(std::move(argument)) {
  if (path_.size() > 1 && path_.back() == '/') path_.pop_back();
}

std::string FileFolder::find(const std::string& name, const FileKind& kind) const {
  const Search search(path_, argument_, name, kind);
  const Search::Found found = search.find();
  if (!found.exists) search.refuse("there is no such file");
  return found.path();
}

OutputFile FileFolder::place(const std::string& name, const FileKind& kind) const {
  std::error_code ignored;  // whether there is a folder shows when it is looked into
  fs::create_directories(path_, ignored);
  const Search search(path_, argument_, name, kind);
  const Search::Found found = search.find();
  if (found.exists) search.checkKind(found);
  return {found.path(), found.parent.value(), found.leaf};
}

}  // namespace grid_path_planner::nodes
