// Reading and writing whole files, with an error message for each failure.
//
//   const std::string text = readWholeFile("site.map", 1 << 20);
//   writeFileAtomically("copy.map", text);
//
// Guaranteed: a reader, a crash or a full disk never meets half of a written file.
//
// A file is written under a random name beside its own, then renamed. The random name cannot be
// planted: a file of that name, or a link, is never opened. What writers that were killed left of
// such names is removed with the next writing of the same file; those that still write are known by
// their lock (flock).
#pragma once

#include <signal.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::base {

// A file open for reading. It is a regular one, which the descriptor itself was asked: a pipe or a
// device would have its reader wait for ever.
class RegularFile {
 public:
  // Throws InputError naming the file where it does not exist, is a directory, a pipe or a device, or
  // cannot be read. None of them is waited for.
  explicit RegularFile(const std::string& file);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::size_t size() const { return size_; }  // bytes, when it was opened
  // At most `count` bytes from `begin`, less where the file ends. Throws InputError.
  std::string read(std::size_t begin, std::size_t count) const;

 private:
  std::string name_;
  int descriptor_;
  std::size_t size_ = 0;
};

// The bytes of `file`. Throws InputError naming the file where RegularFile does, where it is empty and
// where it is larger than `largest` bytes.
std::string readWholeFile(const std::string& file, std::size_t largest);
// The same within `limits`, of which the bytes are taken.
std::string readWholeFile(const std::string& file, std::size_t largest, ReadLimits& limits);

// Removes the mark (EF BB BF) with which editors of Windows begin a text in UTF-8.
void dropByteOrderMark(std::string& content);

// Throws InputError naming the file and the line (from 1) where `text` holds a NUL byte or another
// control character that no text file has: a picture or a bag given by mistake.
void checkIsText(const std::string& text, const std::string& file);

// `file` without its last extension, if its name has one.
std::string withoutExtension(const std::string& file);

// The last extension in lower case, without the dot: "pgm"; "" where there is none.
std::string extensionOf(const std::string& file);

// Where a file is written. Made of a name it is anywhere that the process may write, also behind
// links, so that a function which takes one takes a name.
class OutputFile {
 public:
  OutputFile(std::string name) : name_(std::move(name)) {}  // NOLINT: a name is one
  OutputFile(const char* name) : name_(name) {}             // NOLINT
  // `leaf` in the folder that is open as `folder`, which is duplicated, wherever that folder is moved
  // and whatever takes its name. Links are not followed. `name` is what errors say.
  OutputFile(std::string name, int folder, std::string leaf);

  const std::string& name() const { return name_; }
  // The file `leaf` in the same folder.
  OutputFile beside(const std::string& leaf) const;
  // The file that a link leads to; this one where it is none, or links are not followed.
  OutputFile behindLinks() const;

 private:
  friend class AtomicWriting;
  friend class StreamedFile;
  std::string name_;
  std::shared_ptr<const int> folder_;  // null: by name
  std::string leaf_;
};

// Writes `content` beside `file`, or what a link of that name leads to, renames it over that and
// syncs the folder. An old file's mode and owner stay. Throws InputError naming the file and the
// reason, also where the old file may not be written or its owner not be kept; then it is as it was
// and nothing is left beside it. Throws, too, where the folder cannot be synced: then the new file is there,
// and a loss of power may undo it. Several threads or processes may write the same file: one
// of them wins.
void writeFileAtomically(const OutputFile& file, const std::string& content);

// A file that is written piece by piece, so that what a process wrote is there when it is killed: a log.
class StreamedFile {
 public:
  // An old file is emptied. Throws InputError naming the file where it is no regular one or cannot be
  // written.
  explicit StreamedFile(const OutputFile& file);
  ~StreamedFile();
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;

  // Why they could not all be written (a full disk); empty: they were.
  std::string write(const char* bytes, std::size_t count);

 private:
  int descriptor_;
};

// Writes `part` under a name that is made of `file`'s and of the content of `part`, then `file` with
// the text that `text_naming` makes of that name: name-0123456789abcdef.EXTENSION. Whoever reads a
// name in `file` reads the part that it was written with, whoever is killed or writes meanwhile. Parts
// that earlier writings of `file` left are removed afterwards, if no YAML file in the folder names them and
// no other writer holds the folder (flock). Throws like writeFileAtomically; then `file` and the part that it
// names are as they were, and the new part is not there.
void writeFileWithPart(const OutputFile& file, const std::string& extension,
                       const std::string& part,
                       const std::function<std::string(const std::string& name)>& text_naming);

// Whether a file of this name is a part, and whether it has the content that it was written with.
enum class PartState { NO_PART, AS_WRITTEN, CHANGED };
PartState partState(const std::string& name, const std::string& content);

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
