#include "avoidance/memory/dilation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace grid_path_planner::avoidance {
namespace {

// A row of the ring: slots 0 to 127 along x, of which the last is the neighbour of the first.
struct Row {
  std::uint64_t low, high;

  bool none() const { return (low | high) == 0; }
  bool all() const { return (low & high) == ~std::uint64_t{0}; }
};

Row operator|(Row a, Row b) {
  return {a.low | b.low, a.high | b.high};
}

Row operator~(Row a) {
  return {~a.low, ~a.high};
}

// By 1 <= n <= 63.
Row turnedUp(Row a, int n) {
  return {a.low << n | a.high >> (64 - n), a.high << n | a.low >> (64 - n)};
}

Row turnedDown(Row a, int n) {
  return {a.low >> n | a.high << (64 - n), a.high >> n | a.low << (64 - n)};
}

// The rows of a ball: how far away they are, and how far they reach along x.
struct BallRow {
  int y, z, half;
};

std::vector<BallRow> ballOf(double radius) {
  const double voxels = radius / kVoxel + 1e-9;
  const int reach = static_cast<int>(voxels);
  std::vector<BallRow> rows;
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y) {
      const double rest = voxels * voxels - y * y - z * z;
      if (rest >= 0.0) rows.push_back({y, z, static_cast<int>(std::sqrt(rest))});
    }
  return rows;
}

constexpr int kRows = kRingY * kRingZ;

Row rowAt(const SlotBits& bits, int row) {
  return {bits.words()[2 * row], bits.words()[2 * row + 1]};
}

int rowAway(int row, int y, int z) {
  return (((row >> 7) + z) & (kRingZ - 1)) << 7 | ((row + y) & (kRingY - 1));
}

// The row widened by each number of slots up to `half`.
void widen(Row row, int half, std::vector<Row>& widened) {
  widened[0] = row;
  for (int n = 1; n <= half; ++n)
    widened[n] = widened[n - 1] | turnedUp(row, n) | turnedDown(row, n);
}

// What `rowOf` gives, dilated into `out`, which holds only zeros.
template <class RowOf>
void scatter(double radius, const RowOf& rowOf, SlotBits& out) {
  const std::vector<BallRow> ball = ballOf(radius);
  const int reach = static_cast<int>(radius / kVoxel + 1e-9);
  std::vector<Row> widened(reach + 1);
  for (int row = 0; row < kRows; ++row) {
    const Row bits = rowOf(row);
    if (bits.none()) continue;
    widen(bits, reach, widened);
    for (const BallRow& part : ball) {
      const int target = rowAway(row, part.y, part.z);
      out.words()[2 * target] |= widened[part.half].low;
      out.words()[2 * target + 1] |= widened[part.half].high;
    }
  }
}

}  // namespace

// The complement of what is missing, dilated; rows of which all is missing only empty their neighbours,
// which is told first, so that most rows need no ball.
void erode(const SlotBits& in, double radius, SlotBits& out) {
  std::vector<char> worth(kRows, 0);  // whether a row of `in` holds anything that can remain
  for (int row = 0; row < kRows; ++row) worth[row] = !rowAt(in, row).none();
  out.fill(false);
  const int reach = static_cast<int>(radius / kVoxel + 1e-9);
  const auto matters = [&](int row) {
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        if (worth[rowAway(row, y, z)]) return true;
    return false;
  };
  scatter(
      radius,
      [&](int row) {
        const Row missing = ~rowAt(in, row);
        return missing.none() || !matters(row) ? Row{0, 0} : missing;
      },
      out);
  for (int row = 0; row < kRows; ++row) {
    out.words()[2 * row] = worth[row] ? ~out.words()[2 * row] : 0;
    out.words()[2 * row + 1] = worth[row] ? ~out.words()[2 * row + 1] : 0;
  }
}

void dilate(const SlotBits& in, double radius, SlotBits& out) {
  out.fill(false);
  scatter(
      radius, [&](int row) { return rowAt(in, row); }, out);
}

}  // namespace grid_path_planner::avoidance
