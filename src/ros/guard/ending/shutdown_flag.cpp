#include "ros/guard/ending/shutdown_flag.h"

#include <ros/init.h>

#include <chrono>
#include <utility>

#include "ros/guard/run_node.h"

namespace grid_path_planner::nodes {

ShutdownFlag::ShutdownFlag(base::StopSource stop) : stop_(std::move(stop)) {
  watch_ = std::thread([this] {
    while (!over_) {
      if (nodeIsToEnd() || ros::isShuttingDown()) stop_.cancel();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
}

ShutdownFlag::~ShutdownFlag() {
  over_ = true;
  watch_.join();
}

}  // namespace grid_path_planner::nodes
