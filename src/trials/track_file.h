// Trajectories of a trial as files for evo.
#pragma once

#include <string>
#include <vector>

#include "trials/pose_errors.h"

namespace grid_path_planner::trials {

// As FOLDER/tum/NAME.txt, with NAME as study::fileNameOf() makes it. Throws InputError where it cannot be written.
void writeTrack(const std::string& folder, const std::string& name, const PoseTrack& track);

// What the trajectory of a row, or the truth, is called that has an error set of this name.
std::string trackNameOf(const std::string& set, const std::string& row);
constexpr char kTruth[] = "truth";  // instead of a row

// The names of the files that an error set has trajectories in.
std::vector<std::string> trackFilesOf(const std::string& set);

}  // namespace grid_path_planner::trials
