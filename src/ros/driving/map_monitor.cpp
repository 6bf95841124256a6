#include "ros/driving/map_monitor.h"

#include <utility>

#include "ros/guard/master/system_state.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kMasterPatience = 1.0;  // s, for what it says of the publisher

}  // namespace

MapMonitor::MapMonitor(const ros::NodeHandle& nh, Listener listener)
    : listener_(std::move(listener)) {
  receiver_.start(
      nh, [this](const MapChange&) { onMap(); }, [this] { onHeartbeat(); });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    life_.topic = receiver_.topic();
  }
  tell();
  publisher_ = std::make_unique<PublisherWatch>(PublisherWatch::Callbacks{
      [this] { return whom(); }, [this](const std::string& node) { onAnswer(node); }});
}

MapMonitor::~MapMonitor() {
  receiver_.shutdown();
  publisher_.reset();
}

MapLiveness MapMonitor::life() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return life_;
}

void MapMonitor::tell() {
  const std::lock_guard<std::mutex> lock(telling_);
  listener_(life());
}

void MapMonitor::noteLoss() {
  life_.lost = receiver_.lost();
  life_.lost_since = receiver_.lostSince();
}

void MapMonitor::onMap() {
  ReceivedMap map = receiver_.latest();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    noteLoss();
    if (map.publisher != life_.map.publisher) life_.of_file.reset();
    life_.map = std::move(map);
    if (life_.map.sender == life_.map.publisher) life_.last_heard = life_.map.received;
  }
  tell();
}

void MapMonitor::onHeartbeat() {
  const auto heartbeat = receiver_.heartbeat();
  const MapData data = receiver_.latest().data;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    noteLoss();
    if (heartbeat->publisher != life_.map.publisher) return;
    life_.map.data = data;
    life_.last_heard = heartbeat->received;
  }
  tell();
}

// The publisher of a map without a heartbeat.
std::string MapMonitor::whom() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return life_.map.grid && !life_.map.data.beats() ? life_.map.publisher : "";
}

void MapMonitor::onAnswer(const std::string& node) {
  const MapLiveness before = life();
  const auto of_file = before.map.publisher == node && before.of_file
                           ? before.of_file
                           : offersService(node, "static_map", kMasterPatience);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (life_.map.publisher != node) return;
    life_.of_file = of_file;
    life_.last_heard = std::chrono::steady_clock::now();
  }
  tell();
}

}  // namespace grid_path_planner::nodes
