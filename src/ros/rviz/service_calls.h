// Calls of services that whoever calls does not wait for: each in a thread of its own, with a deadline.
//
//   ServiceCalls calls;
//   calls.start<ComparePlans>(nh, "path_planner/compare_plans", question, 60.0,
//       [](const ComparePlans& answered) { show(answered.response); },
//       [](const std::string& why) { complain(why); });
//   calls.poll();   // ten times a second: calls what was given to start(), in this thread
//
// roscpp knows no deadline: a node that is stopped or never answers holds its caller for ever. At the
// deadline the connection is closed, which ends the call (and tells a node of this package to stop
// working on it).
//
// Guaranteed: each call ends with exactly one of the two functions, unless this object ends before.
// The destructor closes the connections and waits for the threads.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace grid_path_planner::nodes {

class ServiceCalls {
 public:
  using Failed = std::function<void(const std::string& why)>;

  ServiceCalls() = default;
  ~ServiceCalls();
  ServiceCalls(const ServiceCalls&) = delete;
  ServiceCalls& operator=(const ServiceCalls&) = delete;

  // `seconds` of the steady clock. All from one thread, as poll().
  template <class Service>
  void start(const ros::NodeHandle& nh, const std::string& name, const Service& question,
             double seconds, std::function<void(const Service&)> answered, Failed failed) {
    auto service = std::make_shared<Service>(question);
    begin(
        nh.resolveName(name), seconds,
        [own = ros::NodeHandle(nh), name]() mutable {
          return own.serviceClient<Service>(name, true);
        },
        [service](ros::ServiceClient& client) { return client.call(*service); },
        [service, answered = std::move(answered)] { answered(*service); }, std::move(failed));
  }

  void poll();

 private:
  using Connect = std::function<ros::ServiceClient()>;
  using Ask = std::function<bool(ros::ServiceClient&)>;

  struct Task {
    std::string name;
    double seconds = 0.0;
    std::chrono::steady_clock::time_point deadline;
    std::function<void()> answered;
    Failed failed;
    bool told = false;  // that the deadline is over
    std::mutex mutex;   // of what follows
    ros::ServiceClient client;
    bool closed = false, finished = false;
    std::string failure;  // "": it was answered
    std::thread thread;
  };

  void begin(const std::string& name, double seconds, Connect connect, Ask ask,
             std::function<void()> answered, Failed failed);
  static void run(Task& task, const Connect& connect, const Ask& ask);
  static void close(Task& task);
  static bool finished(Task& task);

  std::list<std::unique_ptr<Task>> tasks_;
};

}  // namespace grid_path_planner::nodes
