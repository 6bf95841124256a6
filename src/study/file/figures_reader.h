// The published figures of a study file.
#pragma once

#include "study/file/study_nodes.h"
#include "study/study.h"

namespace grid_path_planner::study {

// `node` is the mapping under `published`. Throws InputError with file and line.
PublishedFigures readFigures(const YAML::Node& node, const StudyNodes& nodes);

}  // namespace grid_path_planner::study
