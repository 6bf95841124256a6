// What a node keeps for one of its name that starts again under the same roscore: where, and under which roscore.
//
//   const std::string run = runId();
//   const std::string file = folder + "/" + keptFileName(private_nh.getNamespace(), run, ".ot");
//   removeOldKeptFiles(file);
//
// The name holds the node's, the master's address and the run, so that no two nodes write the same file: two masters
// may have one address, in two containers or network namespaces that share a folder. It begins with a dot, so that no
// service can be asked to write it.
#pragma once

#include <string>

namespace grid_path_planner::nodes {

// "/a/projected_map", "12ab", ".ot" to ".a.projected_map@HOST_PORT.12ab.ot".
std::string keptFileName(const std::string& node, const std::string& run,
                         const std::string& ending);

// The roscore's /run_id; "" where the master has none, or does not answer.
std::string runId();

// Those of the same node and master's address, but of other runs, that nobody has written for an hour: of roscores
// that have ended. A node whose file is removed so, since nothing has changed for as long, has to write it again.
void removeOldKeptFiles(const std::string& file);

}  // namespace grid_path_planner::nodes
