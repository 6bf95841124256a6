#include "study/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::study {

using base::HoldFileSizeSignal, base::InputError, base::readWholeFile, base::writeFileAtomically;

namespace {

constexpr std::size_t kLargestLog = std::size_t{4} << 30;

InputError systemError(const std::string& file, const std::string& what) {
  return InputError(file, what + ": " + std::strerror(errno));
}

void makeFolders(const std::string& folder) {
  for (std::size_t slash = folder.find('/', 1);; slash = folder.find('/', slash + 1)) {
    const std::string part = folder.substr(0, slash);
    if (::mkdir(part.c_str(), 0755) != 0 && errno != EEXIST)
      throw systemError(part, "cannot be made a folder");
    if (slash == std::string::npos) return;
  }
}

std::string headOf(const std::string& kind, std::uint64_t fingerprint) {
  std::ostringstream out;
  out << "{\"grid_path_planner_" << kind << "\": \"" << std::hex << fingerprint << "\"}\n";
  return out.str();
}

}  // namespace

std::string fileNameOf(std::string name) {
  for (char& letter : name) {
    const bool stays = ('a' <= letter && letter <= 'z') || ('A' <= letter && letter <= 'Z') ||
                       ('0' <= letter && letter <= '9');
    if (!stays) letter = '_';
  }
  return name;
}

RunFolder::RunFolder(std::string folder, std::string kind, std::uint64_t fingerprint)
    : folder_(std::move(folder)), kind_(std::move(kind)) {
  makeFolders(folder_);
  lock();
  try {
    open(fingerprint);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

RunFolder::~RunFolder() {
  ::close(log_);
  ::close(lock_);
}

void RunFolder::lock() {
  const std::string name = file("lock");
  lock_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) throw systemError(name, "cannot be written");
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(lock_);
  throw InputError(folder_, "another " + kind_ + " is writing into this folder");
}

std::string RunFolder::placeOf(std::size_t i) const {
  return file("runs.jsonl") + ':' + std::to_string(i + 2);
}

// Reads whole lines from `begin` on. Returns where they end: the process may have ended within one.
std::size_t RunFolder::readLines(const std::string& text, std::size_t begin) {
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines_.push_back(text.substr(begin, end - begin));
  return begin;
}

void RunFolder::open(std::uint64_t fingerprint) {
  const std::string name = file("runs.jsonl");
  const std::string head = headOf(kind_, fingerprint);
  if (::access(name.c_str(), F_OK) != 0) writeFileAtomically(name, head);
  const std::string text = readWholeFile(name, kLargestLog);
  if (text.compare(0, head.size(), head) != 0)
    throw InputError(name, "holds the runs of another " + kind_ +
                               " (another file, something else that it names, or another version); "
                               "take another folder or remove this one");
  end_ = static_cast<std::int64_t>(readLines(text, head.size()));
  log_ = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
  if (log_ < 0 || ::ftruncate(log_, end_) != 0) throw systemError(name, "cannot be written");
}

void RunFolder::add(const std::string& lines) {
  const HoldFileSizeSignal hold;
  std::size_t done = 0;
  while (done < lines.size()) {
    const ssize_t written = ::pwrite(log_, lines.data() + done, lines.size() - done,
                                     end_ + static_cast<std::int64_t>(done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const InputError error = systemError(file("runs.jsonl"), "cannot be written");
      if (::ftruncate(log_, end_) != 0) throw systemError(file("runs.jsonl"), "cannot be cut back");
      throw error;
    }
    done += static_cast<std::size_t>(written);
  }
  end_ += static_cast<std::int64_t>(lines.size());
}

}  // namespace grid_path_planner::study
