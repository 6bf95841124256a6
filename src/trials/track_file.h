// Trajectories of a trial as files for evo.
#pragma once

#include <string>

#include "trials/pose_errors.h"

namespace grid_path_planner::trials {

// As FOLDER/tum/NAME.txt, with an underscore for all that is no letter or digit. Throws InputError where it
// cannot be written.
void writeTrack(const std::string& folder, const std::string& name, const PoseTrack& track);

}  // namespace grid_path_planner::trials
