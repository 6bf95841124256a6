// The folder into which a study of planners writes (run_folder.h), with its runs read.
#pragma once

#include <string>
#include <vector>

#include "study/run_folder.h"
#include "study/study_run.h"

namespace grid_path_planner::study {

class StudyFolder : public RunFolder {
 public:
  // Throws InputError as RunFolder does, and naming file and line of a run that is damaged.
  StudyFolder(const std::string& folder, std::uint64_t fingerprint);

  // Of earlier sessions.
  const std::vector<StudyRun>& runs() const { return runs_; }

 private:
  std::vector<StudyRun> runs_;
};

}  // namespace grid_path_planner::study
