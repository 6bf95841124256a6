#include "ros/avoidance/map_planner.h"

#ifdef GPP_HAS_SEEN_MAP
#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <utility>

#include "grid_path_planner/base/task_queue.h"
#include "ros/guard/guarded_queue.h"
#include "seen_map/seen_map.h"
#endif

namespace grid_path_planner::nodes {

using avoidance::Frame;
using avoidance::PilotOptions;

using FoundPath = std::vector<Eigen::Vector3d>;

#ifdef GPP_HAS_SEEN_MAP

namespace {

constexpr double kFramePeriod = 0.45;  // s
constexpr int kMostWaiting = 8;        // frames

// A task that failed, of which the log told, leaves its promise broken.
FoundPath pathOf(std::future<FoundPath> answered) {
  try {
    return answered.get();
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

// The map belongs to the thread of the queue, which ends before it.
class MapPlanner::Work {
 public:
  explicit Work(const PilotOptions& options) : map_(options) {}

  void see(const Frame& frame, const PilotOptions& options) {
    const auto kept = kept_at_.find(frame.sensor);
    const bool is_early = kept != kept_at_.end() && frame.time - kept->second < kFramePeriod;
    if (is_early || waiting_ >= kMostWaiting) return;
    kept_at_[frame.sensor] = frame.time;
    ++waiting_;
    queue_.post([this, frame, options](const base::StopSource& stop) {
      --waiting_;
      if (stop.cancelled()) return;
      map_.setOptions(options);
      map_.see(frame);
      map_.insertWaiting();
    });
  }

  std::optional<FoundPath> plan(const Eigen::Vector3d& from, const Eigen::Vector3d& goal) {
    if (!asked_.valid() || goal != goal_) ask(from, goal);
    if (asked_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    return pathOf(std::move(asked_));
  }

  void dropPlan() { asked_ = {}; }

 private:
  void ask(const Eigen::Vector3d& from, const Eigen::Vector3d& goal) {
    const auto answer = std::make_shared<std::promise<FoundPath>>();
    asked_ = answer->get_future();
    goal_ = goal;
    const auto work = [this, from, goal, answer](const base::StopSource& stop) {
      answer->set_value(map_.plan(from, goal, stop));
    };
    queue_.post(work, "plan");
  }

  seen_map::SeenMap map_;
  std::map<int, double> kept_at_;  // s, by sensor
  std::atomic<int> waiting_{0};
  std::future<FoundPath> asked_;
  Eigen::Vector3d goal_ = Eigen::Vector3d::Zero();  // of what is asked
  base::TaskQueue queue_{[](const std::string& error) { tellGivenUp("The map's work", error); }};
};

bool MapPlanner::isBuilt() {
  return true;
}

void MapPlanner::see(const Frame& frame, const PilotOptions& options) {
  if (!work_) work_ = std::make_unique<Work>(options);
  work_->see(frame, options);
}

std::optional<FoundPath> MapPlanner::plan(const Eigen::Vector3d& from,
                                          const Eigen::Vector3d& goal) {
  return work_ ? work_->plan(from, goal) : FoundPath();
}

void MapPlanner::dropPlan() {
  if (work_) work_->dropPlan();
}

#else

class MapPlanner::Work {};

bool MapPlanner::isBuilt() {
  return false;
}

void MapPlanner::see(const Frame&, const PilotOptions&) {}

std::optional<FoundPath> MapPlanner::plan(const Eigen::Vector3d&, const Eigen::Vector3d&) {
  return FoundPath();
}

void MapPlanner::dropPlan() {}

#endif

MapPlanner::MapPlanner() = default;
MapPlanner::~MapPlanner() = default;

void MapPlanner::forget() {
  work_.reset();
}

}  // namespace grid_path_planner::nodes
