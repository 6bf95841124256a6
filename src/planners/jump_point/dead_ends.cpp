#include "planners/jump_point/dead_ends.h"

#include <array>
#include <utility>

#include "planners/core/steps.h"

namespace grid_path_planner::planners {
namespace {

constexpr std::uint64_t kEachByte = 0x0101010101010101U;

}  // namespace

void DeadBranches::reset(int width, int height) {
  width_ = width;
  const std::size_t cells = std::size_t(width) * std::size_t(height);
  natural_.assign(cells, ~NaturalMoves{0});  // never a dead branch
  live_.assign(cells, 255);
  dead_.assign(cells, 0);
  ended_.clear();
}

// Each level removes the steps into the branches that ended, then finds the steps after which no
// step is left.
const std::vector<std::uint8_t>& DeadBranches::liveSteps(int depth) {
  for (int level = 0; level <= depth && !ended_.empty(); ++level) {
    removeStepsInto(ended_);
    ended_.clear();
    for (const std::uint32_t index : touched_) {
      const unsigned now = deadAfter(natural_[index] & (live_[index] * kEachByte));
      const auto fresh = static_cast<std::uint8_t>(now & ~unsigned(dead_[index]));
      if (fresh == 0) continue;
      dead_[index] = static_cast<std::uint8_t>(now);
      ended_.push_back({index, fresh});
    }
  }
  return live_;
}

// The cells that lose a step are those touched.
void DeadBranches::removeStepsInto(const std::vector<Ended>& ended) {
  std::array<std::uint32_t, 8> back{};
  for (unsigned step = 0; step < 8; ++step)
    back[step] = static_cast<std::uint32_t>(-(kSteps[step].row * width_ + kSteps[step].column));
  touched_.clear();
  for (const Ended& end : ended)
    for (unsigned bits = end.after; bits != 0; bits &= bits - 1) {
      const auto step = unsigned(__builtin_ctz(bits));
      const std::uint32_t from = end.index + back[step];
      live_[from] &= static_cast<std::uint8_t>(~(1U << step));
      touched_.push_back(from);
    }
}

}  // namespace grid_path_planner::planners
