#include "ros/localization/inputs/input_health.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

using localization::InputStatistics;
using localization::Source;

InputRecord recordOf(int received, const std::string& refusal = "") {
  InputRecord record("input");
  for (int i = 0; i < received; ++i) record.receive();
  if (!refusal.empty()) record.refuse(refusal);
  return record;
}

InputStatistics usedBefore(std::optional<double> age) {
  InputStatistics statistics;
  statistics.age = age;
  statistics.counts.taken = 40;
  statistics.nis_count = 20;
  statistics.nis_mean = 3.0;
  statistics.nis_bounds = {2.0, 4.0};
  return statistics;
}

InputHealth healthOf(Source source, const InputStatistics& statistics, const InputRecord& record,
                     const VehicleLocalizerOptions& options = {}) {
  return nodes::healthOf(statistics, record, expectationOf(source, options));
}

// Where all sensors were silent, nothing left the history, and minutes later each was "used".
TEST(InputHealth, AnInputIsUsedNoLongerThanItsSilenceMayBe) {
  for (const auto& [source, limit] :
       {std::pair(Source::IMU, 0.5), std::pair(Source::DVL, 3.0), std::pair(Source::DEPTH, 3.0),
        std::pair(Source::USBL, 15.0), std::pair(Source::MARKER, 15.0)}) {
    const InputHealth before = healthOf(source, usedBefore(0.9 * limit), recordOf(40));
    EXPECT_TRUE(before.is_good) << nameOf(source);
    EXPECT_EQ(before.sentence, "used");
    const InputHealth after = healthOf(source, usedBefore(limit + 100.0), recordOf(40));
    EXPECT_FALSE(after.is_good) << nameOf(source);
    EXPECT_EQ(after.sentence.rfind("silent, or refused for 1", 0), 0u) << after.sentence;
  }
}

// One was said to be "silent, or refused" for ever.
TEST(InputHealth, APoseThatWasSetOnceIsNotMissed) {
  EXPECT_TRUE(healthOf(Source::SET_POSE, usedBefore(1000.0), recordOf(1)).is_good);
  const InputHealth refused =
      healthOf(Source::SET_POSE, InputStatistics(), recordOf(1, "its frame must be map"));
  EXPECT_FALSE(refused.is_good);
  EXPECT_EQ(refused.sentence, "silent, or refused: its frame must be map");
}

TEST(InputHealth, CommandsAreNotMissedNorNeededBesideADvl) {
  InputStatistics unused;
  unused.age = 0.1;
  EXPECT_TRUE(healthOf(Source::COMMAND, unused, recordOf(5)).is_good);
  EXPECT_FALSE(healthOf(Source::DVL, unused, recordOf(5)).is_good);
  EXPECT_TRUE(healthOf(Source::COMMAND, InputStatistics(), recordOf(5)).is_good);
}

TEST(InputHealth, AHeadingIsMissedWhereItIsToBeUsed) {
  VehicleLocalizerOptions options;
  EXPECT_TRUE(healthOf(Source::HEADING, usedBefore(9.0), recordOf(5), options).is_good);
  options.use_heading = true;
  EXPECT_FALSE(healthOf(Source::HEADING, usedBefore(9.0), recordOf(5), options).is_good);
  EXPECT_TRUE(healthOf(Source::HEADING, usedBefore(0.1), recordOf(5), options).is_good);
}

TEST(InputHealth, ErrorsThatAreTooLargeAreTold) {
  InputStatistics statistics = usedBefore(0.1);
  statistics.nis_mean = 5.0;
  EXPECT_EQ(healthOf(Source::DVL, statistics, recordOf(40)).sentence,
            "its errors are larger than its covariance says");
  statistics.gated = 21;
  EXPECT_EQ(healthOf(Source::DVL, statistics, recordOf(40)).sentence,
            "most are gated: they contradict the pose");
  EXPECT_EQ(healthOf(Source::DVL, statistics, recordOf(0)).sentence, "not heard");
}

}  // namespace
}  // namespace grid_path_planner::nodes
