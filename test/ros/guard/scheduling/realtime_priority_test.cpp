#include "ros/guard/scheduling/realtime_priority.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <future>
#include <utility>

namespace grid_path_planner::nodes {
namespace {

struct Scheduling {
  int policy;
  int priority;
};

Scheduling schedulingOfThisThread() {
  Scheduling now = {};
  sched_param parameter = {};
  ::pthread_getschedparam(::pthread_self(), &now.policy, &parameter);
  now.priority = parameter.sched_priority;
  return now;
}

// In a thread of its own, which keeps nothing for the tests after it.
template <class Work>
auto inThread(Work work) {
  return std::async(std::launch::async, std::move(work)).get();
}

// As a user whom the system grants nothing.
void giveUpPermission() {
  const rlimit none = {0, 0};
  ::setrlimit(RLIMIT_RTPRIO, &none);
  if (::geteuid() == 0 && ::setuid(65534) != 0) std::exit(9);
}

TEST(RealtimePriority, IsTakenWhereNothingIsSaid) {
  const auto [why, now] = inThread([] {
    std::string why = takeRealtimePriority(1);
    return std::make_pair(std::move(why), schedulingOfThisThread());
  });
  EXPECT_EQ(now.policy, why.empty() ? SCHED_FIFO : SCHED_OTHER) << why;
  EXPECT_EQ(now.priority, why.empty() ? 1 : 0) << why;
}

TEST(RealtimePriority, IsGivenBack) {
  const auto now = inThread([] {
    takeRealtimePriority(1);
    EXPECT_EQ(takeRealtimePriority(0), "");
    return schedulingOfThisThread();
  });
  EXPECT_EQ(now.policy, SCHED_OTHER);
}

TEST(RealtimePriority, ThatIsNotGrantedChangesNothing) {
  const auto ends = [] {
    giveUpPermission();
    const std::string why = takeRealtimePriority(1);
    std::exit(
        why == "Operation not permitted" && schedulingOfThisThread().policy == SCHED_OTHER ? 0 : 1);
  };
  EXPECT_EXIT(ends(), testing::ExitedWithCode(0), "");
}

TEST(RealtimePriority, ThatDoesNotExistIsRefused) {
  EXPECT_EQ(inThread([] { return takeRealtimePriority(1000); }), "Invalid argument");
}

}  // namespace
}  // namespace grid_path_planner::nodes
