// What a localiser's words allow.
#include "ros/gate/localization_gate.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

constexpr DegradedDriving kDegraded{0.5, 30.0};

TEST(LocalizationGate, oneThatNeverSpokeHoldsNothing) {
  const LocalizationGate gate;
  EXPECT_FALSE(gate.problem(1e6, kDegraded));
  EXPECT_EQ(1.0, gate.speedShare(kDegraded));
}

TEST(LocalizationGate, lostHoldsUntilItIsOk) {
  LocalizationGate gate;
  for (const char* const lost : {"LOST: contradicted", "INITIALIZING: waits for a fix"}) {
    EXPECT_TRUE(gate.hear(lost, 1.0));
    EXPECT_EQ("the localiser says " + std::string(lost), gate.problem(1.0, kDegraded).value_or(""));
    EXPECT_TRUE(gate.hear("OK: the pose is known to 0.1 m", 2.0));
    EXPECT_FALSE(gate.problem(2.0, kDegraded));
  }
}

TEST(LocalizationGate, degradedIsSlowAndEndsAndIsGrantedAgain) {
  LocalizationGate gate;
  EXPECT_FALSE(gate.grant(0.0, kDegraded));
  for (double now = 10.0; now < 40.0; now += 1.0) {  // repeated, it does not begin anew
    EXPECT_TRUE(gate.hear("DEGRADED: no fix", now));
    EXPECT_FALSE(gate.problem(now, kDegraded)) << now;
    EXPECT_EQ(0.5, gate.speedShare(kDegraded));
    EXPECT_FALSE(gate.grant(now, kDegraded)) << "nothing has run out";
  }
  EXPECT_TRUE(gate.problem(40.0, kDegraded));
  EXPECT_TRUE(gate.grant(50.0, kDegraded));
  EXPECT_FALSE(gate.problem(79.0, kDegraded));
  EXPECT_TRUE(gate.problem(80.0, kDegraded));
  EXPECT_TRUE(gate.hear("OK: well", 81.0));
  EXPECT_TRUE(gate.hear("DEGRADED: again", 90.0));
  EXPECT_FALSE(gate.problem(119.0, kDegraded)) << "from when it was OK";
}

TEST(LocalizationGate, aTextWithoutAStatusChangesNothing) {
  LocalizationGate gate;
  EXPECT_FALSE(gate.hear("", 1.0));
  EXPECT_FALSE(gate.hear("ok: yes", 1.0));
  EXPECT_FALSE(gate.hear("OKAY: yes", 1.0));
  EXPECT_FALSE(gate.problem(1.0, kDegraded));
  EXPECT_TRUE(gate.hear("LOST", 1.0)) << "without a sentence";
  EXPECT_FALSE(gate.hear("well", 2.0));
  EXPECT_TRUE(gate.problem(2.0, kDegraded));
}

}  // namespace
}  // namespace grid_path_planner::nodes
