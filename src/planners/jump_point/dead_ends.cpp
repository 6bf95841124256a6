#include "planners/jump_point/dead_ends.h"

#include <utility>

#include "planners/core/steps.h"

namespace grid_path_planner::planners {
namespace {

constexpr std::uint64_t kEveryByte = 0x0101010101010101U;

struct Ended {
  std::uint32_t index;
  std::uint8_t after;  // steps after which nothing is natural any more
};

}  // namespace

std::vector<std::uint8_t> liveSteps(const std::vector<NaturalMoves>& natural, int width, int height,
                                    int depth) {
  std::vector<std::uint8_t> live(natural.size(), 255);
  std::vector<std::uint8_t> dead(natural.size());
  std::vector<Ended> ended;
  for (std::uint32_t i = 0; i < natural.size(); ++i) {
    dead[i] = static_cast<std::uint8_t>(deadAfter(natural[i]));
    if (dead[i] != 0) ended.push_back({i, dead[i]});
  }
  // Each level removes the steps into the branches that ended, then finds the steps after which no
  // step is left.
  std::vector<std::uint32_t> touched;
  for (int level = 0; level <= depth && !ended.empty(); ++level) {
    touched.clear();
    for (const Ended& end : ended) {
      const int column = int(end.index) % width, row = int(end.index) / width;
      for (unsigned bits = end.after; bits != 0; bits &= bits - 1) {
        const auto step = unsigned(__builtin_ctz(bits));
        const int from_column = column - kSteps[step].column, from_row = row - kSteps[step].row;
        if (from_column < 0 || from_column >= width || from_row < 0 || from_row >= height) continue;
        const auto from =
            std::uint32_t(from_row) * std::uint32_t(width) + std::uint32_t(from_column);
        live[from] &= static_cast<std::uint8_t>(~(1U << step));
        touched.push_back(from);
      }
    }
    ended.clear();
    for (const std::uint32_t index : touched) {
      const unsigned now = deadAfter(natural[index] & (live[index] * kEveryByte));
      const auto fresh = static_cast<std::uint8_t>(now & ~unsigned(dead[index]));
      if (fresh == 0) continue;
      dead[index] = static_cast<std::uint8_t>(now);
      ended.push_back({index, fresh});
    }
  }
  return live;
}

}  // namespace grid_path_planner::planners
