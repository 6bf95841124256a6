// The folder into which a study writes: its runs, task by task, so that an interrupted study can be
// resumed, and a lock, so that two studies do not write into one folder.
//
// runs.jsonl holds a line with the fingerprint of the study and then a line for each run. A line that
// was cut off (by a full disk, a lost power) is dropped when the study is resumed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grid_path_planner::study {

// `name` as part of a file's: an underscore for all that is no ASCII letter or digit. Names that differ may have one.
std::string fileNameOf(std::string name);

class RunFolder {
 public:
  // Makes the folder where there is none. `kind`: what writes here ("study"), for the first line and for
  // errors; `fingerprint`: of its plan. Throws InputError where another process has the folder, where it
  // holds runs of another study, or cannot be written.
  RunFolder(std::string folder, std::string kind, std::uint64_t fingerprint);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  // The runs of earlier sessions, a line each.
  const std::vector<std::string>& lines() const { return lines_; }
  // The place of lines()[i], for an error: "runs.jsonl:3".
  std::string placeOf(std::size_t i) const;

  // Adds the lines of a finished task. Throws InputError naming the file where they cannot be
  // written; earlier lines stay intact.
  void add(const std::string& lines);

  std::string file(const std::string& name) const { return folder_ + '/' + name; }

 private:
  void lock();
  void open(std::uint64_t fingerprint);
  std::size_t readLines(const std::string& text, std::size_t begin);

  std::string folder_;
  std::string kind_;
  std::vector<std::string> lines_;
  int lock_ = -1;
  int log_ = -1;
  std::int64_t end_ = 0;  // bytes of runs.jsonl that are whole
};

}  // namespace grid_path_planner::study
