// A navigate_path that drives a vehicle which does not move, in a world that the test itself moves.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ros/support/control_thread.h"
#include "ros/support/navigate_fixture.h"

namespace grid_path_planner::test {

class StillTest : public NavigateTest {
 protected:
  // In a StillWorld.
  void drive(std::vector<std::string> arguments = {}) {
    arguments.push_back("_no_progress_timeout:=0");
    startNavigate(arguments);
    publishPath(pathOf({{0, 0}, {50, 0}}));
    ASSERT_TRUE(isDriving());
  }

  // Whether a command that is not zero comes from now on.
  bool isDriving() {
    const std::size_t seen = velocity_.count();
    return velocity_.waitFor(seen, [](const geometry_msgs::Twist& v) { return !isZero(v); })
        .has_value();
  }
  // Whether the last command becomes a zero, and no other comes for a second after it. On a loaded
  // machine the test's own /clock may stand still for half a second before: a stop that does not last.
  bool stops() {
    return waitFor([&] { return lastCommandIsZero() && !drivesWithin(std::chrono::seconds(1)); });
  }

  // Whether /diagnostics of this level has `text` in its message from now on.
  bool reports(int level, const std::string& text) {
    const auto says = [&](const diagnostic_msgs::DiagnosticStatus& status) {
      return status.level == level && status.message.find(text) != std::string::npos;
    };
    return diagnostics_
        .waitFor(diagnostics_.count(),
                 [&](const diagnostic_msgs::DiagnosticArray& array) {
                   return std::any_of(array.status.begin(), array.status.end(), says);
                 })
        .has_value();
  }
  // The value of `key` in the newest diagnostics that have one; empty before.
  std::string reported(const std::string& key) const { return valueIn(diagnostics_.all(), key); }

  // Whether a command that is not zero comes before the deadline.
  bool drivesWithin(std::chrono::seconds deadline) {
    const std::size_t seen = velocity_.count();
    return waitFor(
        [&] {
          const auto all = velocity_.all();
          return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(seen), all.end(),
                             [](const geometry_msgs::Twist& v) { return !isZero(v); });
        },
        deadline);
  }

  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
};

}  // namespace grid_path_planner::test
