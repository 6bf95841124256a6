// Topics are advertised and given up by one thread of a process at a time.
//
//   const auto alone = lockTopics();  // until the end of the block
//
// roscpp's TopicManager::unadvertise() keeps the place of a topic in a list while it lets go of the list's mutex. Where
// another thread adds a topic or takes one out meanwhile, it takes out a wrong one, and the process ends by an
// assertion (`px != 0`) when that is published next. A nodelet manager loads and unloads in one thread, but destroys a
// nodelet in another where a callback of it was just running: that happened in two of some 60 runs of unload.test.
//
// Held while a node is made or destroyed, and by what advertises or gives up a topic while a node runs, which better
// nothing does: advertise() does not return before the master answers. Not guarded: nodelets of other packages
// in the same manager, and the manager's own bonds.
#pragma once

#include <mutex>

namespace grid_path_planner::nodes {

using TopicLock = std::unique_lock<std::recursive_mutex>;

// Waits until no other thread holds it.
TopicLock lockTopics();

// For the threads of a node, which whoever destroys the node waits for and holds it: waits half a second at
// most, and goes on without (owns_lock() is false then).
TopicLock lockTopicsOfRunningNode();

}  // namespace grid_path_planner::nodes
