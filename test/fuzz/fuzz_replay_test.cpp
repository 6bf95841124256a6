// The fuzzer's targets in the normal build: each over its seeds and damaged copies of them.
#include <gtest/gtest.h>

#include <random>

#include "fuzz/fuzz_target.h"
#include "support/mutation.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr int kCopies = 10;  // of each seed

class FuzzReplay : public testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzReplay, AnswersItsSeedsAndDamagedCopiesOfThem) {
  std::mt19937 random(20261122);
  const std::vector<std::string> seeds = GetParam().seeds();
  EXPECT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) {
    EXPECT_NO_THROW(GetParam().run(seed));
    for (int copy = 0; copy < kCopies; ++copy)
      EXPECT_NO_THROW(GetParam().run(test::mutated(seed, random)));
  }
}

TEST_P(FuzzReplay, AnswersNothingAtAll) {
  EXPECT_NO_THROW(GetParam().run(""));
  EXPECT_NO_THROW(GetParam().run(std::string(1, '\0')));
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(fuzzTargets()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace grid_path_planner::fuzz
