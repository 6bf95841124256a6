#include "ros/guard/master/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/system_state.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {
namespace {

using XmlRpc::XmlRpcValue;

constexpr auto kMasterPeriod = std::chrono::seconds(1);
constexpr auto kLongestBetween = std::chrono::seconds(16);
constexpr double kMasterPatience = 1.0;  // that the master is asked

XmlRpcValue self() {
  return XmlRpcValue(ros::this_node::getName());
}

std::string ownUri() {
  return ros::XMLRPCManager::instance()->getServerURI();
}

std::string servicesUri() {
  return "rosrpc://" + ros::network::getHost() + ":" +
         std::to_string(ros::ConnectionManager::instance()->getTCPPort());
}

std::optional<XmlRpcValue> askMaster(const char* method, std::vector<XmlRpcValue> arguments = {}) {
  arguments.insert(arguments.begin(), self());
  return callXmlRpc(masterUri(), method, arguments, kMasterPatience);
}

}  // namespace

std::shared_ptr<MasterWatch> MasterWatch::shared() {
  static std::mutex mutex;
  static std::weak_ptr<MasterWatch> known;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<MasterWatch> watch = known.lock();
  if (!watch) known = watch = std::shared_ptr<MasterWatch>(new MasterWatch);
  watch->services_grow_ = true;
  return watch;
}

MasterWatch::MasterWatch()
    : services_uri_(servicesUri()),
      answered_(Clock::now().time_since_epoch().count()),
      thread_([this] { run(); }) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = true;
  }
  ends_.notify_all();
  thread_.join();
}

double MasterWatch::silence() const {
  const Clock::duration answered(answered_.load());
  return std::chrono::duration<double>(Clock::now().time_since_epoch() - answered).count();
}

void MasterWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!done_) {
    lock.unlock();
    tryToAsk();
    lock.lock();
    ends_.wait_for(lock, kMasterPeriod, [this] { return done_.load(); });
  }
}

void MasterWatch::tryToAsk() noexcept {
  guarded("A question to the master", [this] {
    try {
      ask();
    } catch (const XmlRpc::XmlRpcException& error) {  // no std::exception
      throw std::runtime_error(error.getMessage());
    }
  });
}

void MasterWatch::ask() {
  auto pid = askMaster("getPid");
  if (!pid) {
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(), "The master at " << masterUri() << " does not answer");
    return;
  }
  answered_ = Clock::now().time_since_epoch().count();
  const int before = std::exchange(pid_, static_cast<int&>(*pid));
  const bool restarted = before != 0 && before != pid_;
  if (restarted) ++restarts_;
  if (isOver()) return;
  const std::optional<bool> knows = masterKnows(ros::this_node::getName(), kMasterPatience);
  if (isOver() || ros::isShuttingDown()) return;  // its names are gone because they were given back
  if (!restarted && known_ && !owes_names_ && knows == false) ++restarts_;  // by the same number
  owes_names_ = owes_names_ || restarted || (known_ && knows == false);
  if (owes_names_) owes_names_ = !registersAgain();
  known_ = known_ || knows == true;
  if (!owes_names_ && rememberingIsDue()) rememberServices();
}

// Whoever holds the watch has just made its services, or is about to.
bool MasterWatch::rememberingIsDue() {
  const auto now = Clock::now();
  if (services_grow_.exchange(false)) {
    between_ = kMasterPeriod / 2;
  } else if (now < remembers_at_) {
    return false;
  }
  between_ = std::min<Clock::duration>(2 * between_, kLongestBetween);
  remembers_at_ = now + between_;
  return true;
}

void MasterWatch::rememberServices() {
  const auto state = systemState(kMasterPatience);
  if (isOver()) return;
  auto pid = askMaster("getPid");
  if (!state || !pid || static_cast<int&>(*pid) != pid_) return;  // another one knows none of them
  services_.clear();
  const std::string name = ros::this_node::getName();
  for (const auto& [service, nodes] : state->services)
    if (std::find(nodes.begin(), nodes.end(), name) != nodes.end()) services_.push_back(service);
}

// Whether the master and this process have answered every question; if not, it is all tried again.
bool MasterWatch::registersAgain() const {
  static LogThrottle seldom(10.0);
  ROS_WARN_STREAM_COND(seldom.isDue(), "The master at "
                                           << masterUri()
                                           << " does not know this node: it is registered again");
  bool all = registersTopics("getPublications", "registerPublisher");
  all = registersTopics("getSubscriptions", "registerSubscriber") && all;
  for (const std::string& service : services_) {
    if (isOver()) return false;
    const std::vector<XmlRpcValue> offer = {XmlRpcValue(service), XmlRpcValue(services_uri_),
                                            XmlRpcValue(ownUri())};
    all = askMaster("registerService", offer).has_value() && all;
  }
  return all;
}

// The master answers a subscriber with the publishers of its topic, and tells nobody else.
bool MasterWatch::registersTopics(const char* list, const char* method) const {
  auto topics = callXmlRpc(ownUri(), list, {self()}, kMasterPatience);
  bool all = topics.has_value();
  for (int i = 0; topics && i < topics->size(); ++i) {
    if (isOver()) return false;
    const XmlRpcValue& topic = (*topics)[i][0];
    const auto known = askMaster(method, {topic, (*topics)[i][1], XmlRpcValue(ownUri())});
    all = all && known;
    const bool publishers =
        known && known->getType() == XmlRpcValue::TypeArray && known->size() > 0;
    if (publishers && std::string(method) == "registerSubscriber")
      all = callXmlRpc(ownUri(), "publisherUpdate", {XmlRpcValue("/master"), topic, *known},
                       kMasterPatience) &&
            all;
  }
  return all;
}

}  // namespace grid_path_planner::nodes
