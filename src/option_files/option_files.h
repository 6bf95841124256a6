// The files that repeat what visitOptions says of a node's options: config/<node>.yaml, the .cfg of
// dynamic_reconfigure and the tables of the documentation.
//
//   const NodeOptions node{"path_planner", "PathPlanner",
//                          describeOptions(PathPlannerNodeOptions())};
//   writeFileAtomically("config/path_planner.yaml", yamlOf(node));
//
// Guaranteed: every option is in each of them, in the order of its visitOptions, with its default.
// The .cfg states no min and max: dynamic_reconfigure would clamp to them without a word, where the
// node refuses what is out of limits and says why.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/base/option_text.h"

namespace grid_path_planner::option_files {

struct NodeOptions {
  std::string node;    // path_planner
  std::string config;  // PathPlanner, of PathPlanner.cfg and PathPlannerConfig.h
  std::vector<base::OptionDescription> options;
};

// Parameters for rosparam, with unit, limits and description as a comment. Lines have at most 120
// columns unless a word is longer.
std::string yamlOf(const NodeOptions& node);

// A Python program for generate_dynamic_reconfigure_options(). Names are those of configName().
std::string cfgOf(const NodeOptions& node);

// A table in Markdown, without a newline at its end.
std::string tableOf(const NodeOptions& node);

// `page` with the table of each node between <!-- parameters: NODE --> and <!-- end -->. Throws
// InputError for a node that is not in `nodes` and for a missing end.
std::string withTables(const std::string& page, const std::vector<NodeOptions>& nodes);

// `page` with `text` between the line `opening`, where it has one, and <!-- end -->. Throws InputError for a missing end.
std::string withText(const std::string& page, const std::string& opening, const std::string& text);

}  // namespace grid_path_planner::option_files
