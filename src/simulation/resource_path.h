// Where the files lie that a world file names.
#pragma once

#include <string>

namespace grid_path_planner::simulation {

// The file or folder that `uri` means when it stands in a file of the folder `folder`:
//   model://NAME/...       below one of the folders world_folder, world_folder/.., those of
//                          GAZEBO_MODEL_PATH and those of SDF_PATH; the first in which it exists
//   file:///ABSOLUTE, /ABSOLUTE
//   file://NAME, NAME      relative to `folder`
// "" where there is nothing of that name, or the scheme is another one.
std::string resourcePath(const std::string& uri, const std::string& folder,
                         const std::string& world_folder);

}  // namespace grid_path_planner::simulation
