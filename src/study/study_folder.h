// The folder into which a study writes: its runs, unit by unit, so that an interrupted study can be
// resumed, and a lock, so that two studies do not write into one folder.
//
// runs.jsonl holds a line with the fingerprint of the study and then a line for each run. A line that
// was cut off (by a full disk, a lost power) is dropped when the study is resumed, with its unit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/study_run.h"

namespace grid_path_planner::study {

class StudyFolder {
 public:
  // Makes the folder where there is none. `fingerprint`: of the plan. Throws InputError where
  // another process has the folder, where it holds runs of another study, or cannot be written.
  StudyFolder(std::string folder, std::uint64_t fingerprint);
  ~StudyFolder();
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  // The runs of earlier sessions.
  const std::vector<StudyRun>& runs() const { return runs_; }

  // Adds the runs of a finished unit. Throws InputError naming the file where they cannot be
  // written; earlier runs stay intact.
  void add(const std::string& lines);

  std::string file(const std::string& name) const { return folder_ + '/' + name; }

 private:
  void lock();
  void open(std::uint64_t fingerprint);
  std::size_t readRuns(const std::string& name, const std::string& text, std::size_t begin);

  std::string folder_;
  std::vector<StudyRun> runs_;
  int lock_ = -1;
  int log_ = -1;
  std::int64_t end_ = 0;  // bytes of runs.jsonl that are whole
};

}  // namespace grid_path_planner::study
