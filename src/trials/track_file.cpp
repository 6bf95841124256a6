#include "trials/track_file.h"

#include <filesystem>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "study/run_folder.h"
#include "trials/trial_rows.h"

namespace grid_path_planner::trials {

void writeTrack(const std::string& folder, const std::string& name, const PoseTrack& track) {
  const std::string tracks = folder + "/tum";
  std::error_code error;
  std::filesystem::create_directories(tracks, error);
  if (error) throw base::InputError(tracks, "cannot be made a folder: " + error.message());
  base::writeFileAtomically(tracks + '/' + study::fileNameOf(name) + ".txt", tumText(track));
}

std::string trackNameOf(const std::string& set, const std::string& row) {
  return set + '_' + row;
}

std::vector<std::string> trackFilesOf(const std::string& set) {
  std::vector<std::string> files = {study::fileNameOf(trackNameOf(set, kTruth))};
  for (const TrialRow& row : trialRows())
    files.push_back(study::fileNameOf(trackNameOf(set, row.name)));
  return files;
}

}  // namespace grid_path_planner::trials
