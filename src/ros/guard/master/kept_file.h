// What a node keeps for one of its name that starts again under the same roscore: where, and under which roscore.
//
//   const std::string run = runIdAtStart();
//   const std::string file = folder + "/" + keptFileName(private_nh.getNamespace(), run, ".ot");
//   if (!run.empty()) removeOldKeptFiles(file);
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

// The same for a node that starts: what it has kept is lost where a question fails. Asked again for as long as the
// master does not say that it has none, ten times at most.
std::string runIdAtStart();

// Those of the same node and master's address, but of other runs, that nobody has written for an hour: of roscores
// that have ended. Precondition: the run is known, else its own are among them. A node whose file is removed so, since nothing has changed for as long, has to write it again.
void removeOldKeptFiles(const std::string& file);

}  // namespace grid_path_planner::nodes
