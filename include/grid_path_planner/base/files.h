// Reading and writing whole files, with an error message for each failure.
//
//   const std::string text = readWholeFile("site.map", 1 << 20);
//   writeFileAtomically("copy.map", text);
//
// Guaranteed: a reader, a crash or a full disk never meets half of a written file.
#pragma once

#include <signal.h>

#include <cstddef>
#include <string>

namespace grid_path_planner::base {

// The bytes of `file`. Throws InputError naming the file where it does not exist, is a directory,
// cannot be read, is empty or is larger than `largest` bytes.
std::string readWholeFile(const std::string& file, std::size_t largest);

// Throws InputError naming the file and the line (from 1) where `text` holds a NUL byte or another
// control character that no text file has: a picture or a bag given by mistake.
void checkIsText(const std::string& text, const std::string& file);

// `file` without its last extension, if its name has one.
std::string withoutExtension(const std::string& file);

// The last extension in lower case, without the dot: "pgm"; "" where there is none.
std::string extensionOf(const std::string& file);

// Writes `content` beside `file`, or what a link of that name leads to, and renames it over that.
// Devices and pipes are written to as they are. Throws InputError naming the file and
// the reason; then `file` is as it was and nothing is left beside it. Several threads or processes
// may write the same file: one of them wins.
void writeFileAtomically(const std::string& file, const std::string& content);

// Around writes: a write beyond RLIMIT_FSIZE sends SIGXFSZ, which would end the process before the
// error is seen. While one of these lives, the calling thread gets EFBIG instead; other threads are
// left alone.
class HoldFileSizeSignal {
 public:
  HoldFileSizeSignal();
  ~HoldFileSizeSignal();
  HoldFileSizeSignal(const HoldFileSizeSignal&) = delete;
  HoldFileSizeSignal& operator=(const HoldFileSizeSignal&) = delete;

 private:
  sigset_t held_;
  sigset_t before_;
};

}  // namespace grid_path_planner::base
