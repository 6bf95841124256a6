// The fuzzer's targets in the normal build: each over its seeds and damaged copies of them, which take no longer than
// scripts/fuzz allows; and over all that the fuzzer has kept, where GPP_FUZZ_CORPUS names the folder
// (~/.cache/grid_path_planner/fuzz).
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>

#include "fuzz/fuzz_target.h"
#include "support/bounded_run.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr int kCopies = 10;  // of each seed
// Of the processor, for one input.
constexpr double kMostSeconds = test::hasShadowMemory() ? 20.0 : 5.0;

double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void expectAnswer(const FuzzTarget& target, const std::string& input) {
  const double begin = processorSeconds();
  EXPECT_NO_THROW(target.run(input));
  EXPECT_LE(processorSeconds() - begin, kMostSeconds) << testing::PrintToString(input);
}

// Inputs that grew the coverage, and those that were found to take long.
std::vector<std::string> kept(const std::string& target) {
  std::vector<std::string> inputs;
  const char* corpus = std::getenv("GPP_FUZZ_CORPUS");
  if (corpus == nullptr) return inputs;
  for (const char* kind : {"", "-findings"}) {
    const std::filesystem::path folder = corpus + ("/" + target) + kind;
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      inputs.push_back(test::contentOf(entry.path().string()));
  }
  return inputs;
}

class FuzzReplay : public testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzReplay, AnswersItsSeedsAndDamagedCopiesOfThem) {
  std::mt19937 random(20261122);
  const std::vector<std::string> seeds = GetParam().seeds();
  EXPECT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) {
    expectAnswer(GetParam(), seed);
    for (int copy = 0; copy < kCopies; ++copy)
      expectAnswer(GetParam(), test::mutated(seed, random));
  }
  for (const std::string& input : kept(GetParam().name)) expectAnswer(GetParam(), input);
}

TEST_P(FuzzReplay, AnswersNothingAtAll) {
  expectAnswer(GetParam(), "");
  expectAnswer(GetParam(), std::string(1, '\0'));
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(fuzzTargets()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace grid_path_planner::fuzz
