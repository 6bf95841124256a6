#include "trials/track_file.h"

#include <cctype>
#include <filesystem>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::trials {

void writeTrack(const std::string& folder, const std::string& name, const PoseTrack& track) {
  const std::string tracks = folder + "/tum";
  std::error_code error;
  std::filesystem::create_directories(tracks, error);
  if (error) throw base::InputError(tracks, "cannot be made a folder: " + error.message());
  std::string file = name;
  for (char& letter : file)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  base::writeFileAtomically(tracks + '/' + file + ".txt", tumText(track));
}

}  // namespace grid_path_planner::trials
