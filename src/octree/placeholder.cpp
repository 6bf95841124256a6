#include "grid_path_planner/octree/scan.h"

namespace grid_path_planner {}
