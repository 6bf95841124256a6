#include "ros/driving/map_watch.h"

#include <utility>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPublisherPeriod = std::chrono::seconds(1);
constexpr double kPublisherPatience = 1.0;  // that the publisher is asked

}  // namespace

MapWatch::MapWatch(const ros::NodeHandle& nh, Listener listener) : listener_(std::move(listener)) {
  receiver_.start(
      nh, [this](const MapChange&) { onMap(); }, [this] { onHeartbeat(); });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    life_.topic = receiver_.topic();
  }
  tell();
  thread_ = std::thread([this] { run(); });
}

MapWatch::~MapWatch() {
  receiver_.shutdown();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = true;
  }
  ends_.notify_all();
  thread_.join();
}

MapLife MapWatch::life() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return life_;
}

void MapWatch::tell() {
  const std::lock_guard<std::mutex> lock(telling_);
  listener_(life());
}

void MapWatch::noteLoss() {
  life_.lost = receiver_.lost();
  life_.lost_since = receiver_.lostSince();
}

void MapWatch::onMap() {
  ReceivedMap map = receiver_.latest();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    noteLoss();
    life_.map = std::move(map);
    life_.heartbeat = life_.map.publisher == heartbeat_of_;
    if (!life_.heartbeat) life_.newest = life_.map.stamp;
    if (life_.map.sender == life_.map.publisher) life_.sign = life_.map.received;
  }
  tell();
}

void MapWatch::onHeartbeat() {
  const auto heartbeat = receiver_.heartbeat();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    noteLoss();
    // Another's heartbeat does not end the watch of those of the map's own publisher.
    if (life_.heartbeat && heartbeat->publisher != heartbeat_of_) return;
    heartbeat_of_ = heartbeat->publisher;
    life_.heartbeat = life_.map.publisher == heartbeat_of_;
    if (!life_.heartbeat) return;  // of a map that has not come
    life_.newest = heartbeat->stamp;
    life_.sign = heartbeat->received;
  }
  tell();
}

void MapWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!done_) {
    lock.unlock();
    try {
      askPublisher();
    } catch (...) {
      tellGivenUp("A question to the map's publisher");
    }
    lock.lock();
    ends_.wait_for(lock, kPublisherPeriod, [this] { return done_; });
  }
}

// Of a map without a heartbeat.
void MapWatch::askPublisher() {
  std::string node;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!life_.map.grid || life_.heartbeat) return;
    node = life_.map.publisher;
  }
  if (node != node_) uri_.clear();
  node_ = node;
  if (!publisherAnswers()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (life_.map.publisher != node) return;
    life_.sign = Clock::now();
  }
  tell();
}

// Where it does not, the next time at the URI that the master knows by then.
bool MapWatch::publisherAnswers() {
  try {
    if (uri_.empty()) uri_ = uriOfNode(node_, kPublisherPatience).value_or("");
    if (!uri_.empty() && answersXmlRpc(uri_, kPublisherPatience)) return true;
  } catch (...) {
    tellGivenUp("A question to the map's publisher");
  }
  uri_.clear();
  return false;
}

}  // namespace grid_path_planner::nodes
