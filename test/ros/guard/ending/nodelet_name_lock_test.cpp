// Seen with the thread sanitizer: navigate_path was not loaded again, "the node /navigate_path offers /navigate_path", since the one
// that had been unloaded before still waited for its turn to leave its topics.
#include "ros/guard/ending/nodelet_name_lock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

namespace grid_path_planner::nodes {
namespace {

TEST(NodeletNameLock, WaitsForTheOneBeforeItAndForNoOther) {
  std::optional<NodeletNameLock> former("/navigate_path");
  const NodeletNameLock other("/teleop_joy");
  std::atomic<bool> is_gone{false};
  auto next = std::async(std::launch::async, [&] {
    const NodeletNameLock name("/navigate_path");
    return is_gone.load();
  });
  EXPECT_EQ(next.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  is_gone = true;
  former.reset();
  EXPECT_TRUE(next.get());
  const NodeletNameLock last("/navigate_path");
}

}  // namespace
}  // namespace grid_path_planner::nodes
