// What was seen before, in the debugger, of a nodelet manager with the address sanitizer on a busy machine: roscpp ends its services while it holds
// the lock of their list, and GuardedQueue waits for their callbacks; one that had just begun asked that list for the
// connection of its client, and waited for the lock. Neither SIGINT nor SIGTERM ended the process any more.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdlib>
#include <future>
#include <iostream>
#include <string>
#include <thread>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/support/process.h"

namespace grid_path_planner::nodes {
namespace {

using Call = ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>;

TEST(EndOfServices, DoesNotWaitForWhoAsksForItsClient) {
  ros::CallbackQueue served;
  GuardedQueue queue(served);
  ros::AsyncSpinner spinner(1, &served);
  spinner.start();
  ros::NodeHandle nh;
  nh.setCallbackQueue(&queue);
  std::promise<void> begun, ended;
  std::promise<bool> gone;
  const auto answer = [&](Call& call) {
    const std::string name = nh.resolveName("answers");
    const ServiceCaller caller(name, call.getConnectionHeader());
    EXPECT_FALSE(caller.gone());
    begun.set_value();
    EXPECT_TRUE(test::waitFor([&] { return caller.gone(); }));  // closed under that lock
    gone.set_value(ServiceCaller(name, call.getConnectionHeader()).gone());
    return true;
  };
  const ros::ServiceServer server = advertiseServiceBySpec<Call>(nh, "answers", answer);
  std::thread client([] {
    std_srvs::Trigger call;
    ros::service::call("answers", call);
  });
  begun.get_future().wait();
  std::thread end([&] {
    ros::shutdown();
    ended.set_value();
  });
  if (ended.get_future().wait_for(std::chrono::seconds(60)) != std::future_status::ready) {
    std::cerr << "ros::shutdown() does not return" << std::endl;
    std::_Exit(1);  // its threads could not be joined
  }
  EXPECT_TRUE(gone.get_future().get());
  end.join();
  client.join();
}

}  // namespace
}  // namespace grid_path_planner::nodes
