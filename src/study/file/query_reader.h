// The queries of a study file.
#pragma once

#include "grid_path_planner/base/read_limits.h"
#include "study/file/study_nodes.h"
#include "study/study.h"

namespace grid_path_planner::study {

// `node` is the mapping under `queries`. Throws InputError with file and line, and where it exceeds
// the limits.
QuerySource readQueries(const YAML::Node& node, const StudyNodes& nodes,
                        const base::ReadLimits& limits);

}  // namespace grid_path_planner::study
