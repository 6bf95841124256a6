#include "ros/driving/publisher_watch.h"

#include <chrono>
#include <utility>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

constexpr auto kPeriod = std::chrono::seconds(1);
constexpr double kPatience = 1.0;  // s

}  // namespace

PublisherWatch::PublisherWatch(Callbacks callbacks)
    : callbacks_(std::move(callbacks)), thread_([this] { run(); }) {}

PublisherWatch::~PublisherWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = true;
  }
  ends_.notify_all();
  thread_.join();
}

void PublisherWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!done_) {
    lock.unlock();
    guarded("A question to a publisher", [this] { ask(); });
    lock.lock();
    ends_.wait_for(lock, kPeriod, [this] { return done_; });
  }
}

void PublisherWatch::ask() {
  const std::string node = callbacks_.whom();
  if (node.empty()) return;
  if (node != node_) uri_.clear();
  node_ = node;
  if (answersNow()) callbacks_.answers(node);
}

// Where it does not, the next time at the URI that the master knows by then.
bool PublisherWatch::answersNow() {
  bool answers = false;
  guarded("A question to a publisher", [&] {
    if (uri_.empty()) uri_ = uriOfNode(node_, kPatience).value_or("");
    answers = !uri_.empty() && answersXmlRpc(uri_, kPatience);
  });
  if (!answers) uri_.clear();
  return answers;
}

}  // namespace grid_path_planner::nodes
