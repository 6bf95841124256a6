#include "ros/input/whole_map_subscription.h"

#include <algorithm>
#include <utility>

#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kMasterSilence = 2.0;  // s, after which it counts as gone
// Where none comes, or none that has what was lost.
constexpr std::chrono::seconds kLongestAnswer(64);

}  // namespace

void WholeMapSubscription::start(ros::NodeHandle nh, std::string topic,
                                 std::function<void(const MapEvent&)> on_map) {
  nh_ = std::move(nh);
  name_ = std::move(topic);
  on_map_ = std::move(on_map);
  master_ = MasterWatch::shared();
  subscribe();
}

void WholeMapSubscription::subscribe() {
  subscriber_ = subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(nh_, name_, 1, on_map_);
}

void WholeMapSubscription::ask() {
  const auto now = Clock::now();
  if (now - asked_at_ < until_asked_again_ || master_->silence() > kMasterSilence) return;
  asked_at_ = now;
  until_asked_again_ = std::clamp<Clock::duration>(2 * until_asked_again_, kAnswer, kLongestAnswer);
  subscriber_.shutdown();  // a second subscription of a node would share the
                           // link of the first
  subscribe();
}

void WholeMapSubscription::retry() {
  if (!subscriber_ && master_->silence() < kMasterSilence) subscribe();
}

}  // namespace grid_path_planner::nodes
