#include "ros/guard/ending/nodelet_name_lock.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <utility>

namespace grid_path_planner::nodes {
namespace {

constexpr std::chrono::seconds kTimeout(10);

struct HeldNames {
  std::mutex mutex;
  std::condition_variable released;
  std::multiset<std::string> names;
};

HeldNames& held() {
  static HeldNames names;
  return names;
}

}  // namespace

NodeletNameLock::NodeletNameLock(std::string name) : name_(std::move(name)) {
  std::unique_lock<std::mutex> lock(held().mutex);
  held().released.wait_for(lock, kTimeout, [this] { return held().names.count(name_) == 0; });
  held().names.insert(name_);
}

NodeletNameLock::~NodeletNameLock() {
  {
    const std::lock_guard<std::mutex> lock(held().mutex);
    held().names.erase(held().names.find(name_));
  }
  held().released.notify_all();
}

}  // namespace grid_path_planner::nodes
