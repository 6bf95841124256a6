// Poses along a path, between its corners.
//
//   Path poses = spacedPoses(path, 0.05, HeadingMode::FORWARD);
//
// Followers that go from pose to pose, without regard to the lines between, need them near one
// another. The corners stay to the last bit, and so do line and turning.
#pragma once

#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// Between two corners in equal parts of at most `spacing` metres, position by position on the line
// between them; 0 or less: the path as it is. `mode` is the one that the path's headings were made
// with. At most a million poses are added to a path: where they would be more, they stand as much
// further apart.
Path spacedPoses(const Path& path, double spacing, HeadingMode mode);

}  // namespace grid_path_planner::path
