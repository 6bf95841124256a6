// What a node keeps for one of its name that starts again under the same roscore: where, and under which roscore.
//
//   const std::string file = folder + "/" + keptFileName(private_nh.getNamespace(), ".ot");
//   const std::string run = runId();
//
// The name holds the node's and the master's address, so that no two nodes write the same file, and begins with a
// dot, so that no service can be asked to write it.
#pragma once

#include <string>

namespace grid_path_planner::nodes {

// "/a/projected_map", ".ot" to ".a.projected_map@HOST_PORT.ot".
std::string keptFileName(const std::string& node, const std::string& ending);

// The roscore's /run_id; "" where the master has none, or does not answer.
std::string runId();

}  // namespace grid_path_planner::nodes
