// A nodelet's name, held from before the nodelet is made until it is gone.
//
//   const NodeletNameLock name("/navigate_path");  // waits while another one of this process holds it
//
// A manager forgets a nodelet that it unloads at once, though it lives on while a callback of it runs, and until it is its turn
// to leave its topics. Who loads another one of that name meanwhile would be refused by a node that is ending, or share its
// services.
#pragma once

#include <string>

namespace grid_path_planner::nodes {

class NodeletNameLock {
 public:
  // Waits ten seconds at most, and goes on then: the two are told apart by what they offer (command_claim.h).
  explicit NodeletNameLock(std::string name);
  ~NodeletNameLock();
  NodeletNameLock(const NodeletNameLock&) = delete;
  NodeletNameLock& operator=(const NodeletNameLock&) = delete;

 private:
  const std::string name_;
};

}  // namespace grid_path_planner::nodes
