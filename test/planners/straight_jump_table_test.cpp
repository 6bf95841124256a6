#include "planners/jump_point/straight_jump_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using End = StraightJumpTable::End;

namespace {

// One line, cell by cell.
struct SlowLine {
  std::vector<CostGrid::Weight> weights;
  std::vector<bool> stop, dead;

  template <bool kForward>
  unsigned end(unsigned from) const {
    do from = kForward ? from + 1 : from - 1;
    while (!stop[from]);
    return from;
  }
  template <bool kForward>
  std::uint64_t cost(unsigned from, unsigned to) const {
    std::uint64_t sum = 0;
    for (unsigned i = std::min(from, to); i < std::max(from, to); ++i)
      sum += std::max(weights[i], weights[i + 1]);
    return sum;
  }
};

template <bool kForward>
void expectAlike(const StraightJumpTable& table, std::size_t line, const SlowLine& slow) {
  const auto length = unsigned(slow.weights.size());
  for (unsigned from = kForward ? 0 : 1; from < length - (kForward ? 1 : 0); ++from) {
    const unsigned end = slow.end<kForward>(from);
    const auto jump = table.straightJump<kForward>(line, from, slow.weights.data(), 1);
    ASSERT_EQ(jump.to, end) << "from " << from;
    ASSERT_EQ(jump.weights, slow.cost<kForward>(from, end)) << "from " << from;
    ASSERT_EQ(table.end<kForward>(line, from), slow.dead[end] ? End::DEAD : End::LIVE)
        << "from " << from;
  }
}

template <bool kForward>
void checkEdits(std::mt19937& random) {
  const unsigned length = 1 + random() % 200;
  SlowLine slow{std::vector<CostGrid::Weight>(length, 3), std::vector<bool>(length, false),
                std::vector<bool>(length, false)};
  StraightJumpTable table;
  table.reset(3, length);
  for (unsigned at = 0; at < length; at += 64)
    StraightJumpTable::writeStops<kForward>(table.word(1, at), 0, 0, End::UNKNOWN);
  const auto set = [&](unsigned at, bool stop, bool dead) {
    slow.stop[at] = stop;
    slow.dead[at] = dead;
    table.setStop<kForward>(1, at, stop, dead);
  };
  for (unsigned at = 0; at + 1 < length; ++at) {
    if (random() % 4 == 0) slow.weights[at + 1] = static_cast<CostGrid::Weight>(random() % 9);
    if (slow.weights[at] != slow.weights[at + 1])
      table.word(1, at).change |= std::uint64_t{1} << (at & 63U);
  }
  set(0, true, true);
  set(length - 1, true, true);
  const unsigned rarity = 1 + random() % 60;
  for (int edit = 0; edit < 300; ++edit) {
    const unsigned at = random() % length;
    const bool last = at == 0 || at == length - 1;
    const bool stop = last || random() % rarity == 0;
    set(at, stop, stop && random() % 2 == 0);
    if (edit % 10 == 0) expectAlike<kForward>(table, 1, slow);
  }
}

TEST(StraightJumpTableLaw, JumpsToTheFirstStopAndKnowsDeadEnds) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    checkEdits<true>(random);
    checkEdits<false>(random);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
