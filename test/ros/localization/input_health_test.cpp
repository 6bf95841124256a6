#include "ros/localization/inputs/input_health.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

using localization::InputStatistics;
using localization::Source;

InputCounts countsOf(std::uint64_t received) {
  InputCounts counts;
  counts.received = received;
  return counts;
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

InputHealth healthOf(Source source, const InputStatistics& statistics, const InputCounts& counts,
                     const VehicleLocalizerOptions& options = {},
                     const std::optional<std::string>& problem = {}) {
  return nodes::healthOf(statistics, counts, problem, expectationOf(source, options));
}

// Where all sensors were silent, nothing left the history, and minutes later each was "used".
TEST(InputHealth, AnInputIsUsedNoLongerThanItsSilenceMayBe) {
  for (const auto& [source, limit] :
       {std::pair(Source::IMU, 0.5), std::pair(Source::DVL, 3.0), std::pair(Source::DEPTH, 3.0),
        std::pair(Source::USBL, 15.0), std::pair(Source::MARKER, 15.0)}) {
    const InputHealth before = healthOf(source, usedBefore(0.9 * limit), countsOf(40));
    EXPECT_TRUE(before.is_good) << nameOf(source);
    EXPECT_EQ(before.sentence, "used");
    const InputHealth after = healthOf(source, usedBefore(limit + 100.0), countsOf(40));
    EXPECT_FALSE(after.is_good) << nameOf(source);
    EXPECT_EQ(after.sentence.rfind("silent for 1", 0), 0u) << after.sentence;
  }
}

// One was said to be "silent, or refused" for ever.
TEST(InputHealth, APoseThatWasSetOnceIsNotMissed) {
  EXPECT_TRUE(healthOf(Source::SET_POSE, usedBefore(1000.0), countsOf(1)).is_good);
  const InputHealth refused =
      healthOf(Source::SET_POSE, InputStatistics(), countsOf(1), {}, "its frame must be map");
  EXPECT_FALSE(refused.is_good);
  EXPECT_EQ(refused.sentence, "its frame must be map");
}

TEST(InputHealth, CommandsAreNotMissedNorNeededBesideADvl) {
  InputStatistics unused;
  unused.age = 0.1;
  EXPECT_TRUE(healthOf(Source::COMMAND, unused, countsOf(5)).is_good);
  EXPECT_FALSE(healthOf(Source::DVL, unused, countsOf(5)).is_good);
  EXPECT_TRUE(healthOf(Source::COMMAND, InputStatistics(), countsOf(5)).is_good);
}

TEST(InputHealth, AHeadingIsMissedWhereItIsToBeUsed) {
  VehicleLocalizerOptions options;
  EXPECT_TRUE(healthOf(Source::HEADING, usedBefore(9.0), countsOf(5), options).is_good);
  options.use_heading = true;
  EXPECT_FALSE(healthOf(Source::HEADING, usedBefore(9.0), countsOf(5), options).is_good);
  EXPECT_TRUE(healthOf(Source::HEADING, usedBefore(0.1), countsOf(5), options).is_good);
}

TEST(InputHealth, ErrorsThatAreTooLargeAreTold) {
  InputStatistics statistics = usedBefore(0.1);
  statistics.nis_mean = 5.0;
  EXPECT_EQ(healthOf(Source::DVL, statistics, countsOf(40)).sentence,
            "its errors are larger than its covariance says");
  statistics.gated = 21;
  EXPECT_EQ(healthOf(Source::DVL, statistics, countsOf(40)).sentence,
            "most are gated: they contradict the pose");
  EXPECT_EQ(healthOf(Source::DVL, statistics, countsOf(0)).sentence, "not heard");
}

}  // namespace
}  // namespace grid_path_planner::nodes
