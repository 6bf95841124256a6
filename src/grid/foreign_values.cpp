#include "grid/foreign_values.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace grid_path_planner::grid {
namespace {

constexpr std::int8_t kLethal = 100, kInscribed = 99;  // of costmap_2d
constexpr std::uint32_t kRowsBetweenQuestions = 64;

// Which values a map has.
class Seen {
 public:
  void add(std::int8_t value) { seen_[static_cast<std::uint8_t>(value)] = true; }
  // Of this class, the lowest and the highest; `lowest` is above `highest` where there is none.
  struct Range {
    int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();
    bool empty() const { return lowest > highest; }
  };
  Range rangeOf(Occupancy occupancy, const OccupancyThresholds& thresholds) const {
    Range range;
    for (int value = 0; value <= 100; ++value) {
      if (!seen_[value] || thresholds.classify(static_cast<std::int8_t>(value)) != occupancy)
        continue;
      range.lowest = std::min(range.lowest, value);
      range.highest = std::max(range.highest, value);
    }
    return range;
  }

 private:
  std::array<bool, 256> seen_{};
};

std::string textOf(bool has_free, bool has_occupied, const Seen::Range& between,
                   const OccupancyThresholds& thresholds) {
  const std::string free = "free (at most free_max, " + std::to_string(thresholds.free_max) + ")";
  const std::string occupied =
      "occupied (at least occupied_min, " + std::to_string(thresholds.occupied_min) + ")";
  const std::string none = has_free ? occupied : has_occupied ? free : free + " or " + occupied;
  return "no cell of the map is " + none + ": its values from " + std::to_string(between.lowest) +
         " to " + std::to_string(between.highest) + " count as unknown";
}

}  // namespace

const std::string& ThresholdFit::problem(const std::shared_ptr<const OccupancyGrid>& map,
                                         const OccupancyThresholds& thresholds,
                                         const base::StopToken& stop) {
  const bool same_map = !map_.owner_before(map) && !map.owner_before(map_);
  if (same_map && thresholds.free_max == thresholds_.free_max &&
      thresholds.occupied_min == thresholds_.occupied_min)
    return problem_;
  map_.reset();
  thresholds_ = thresholds;
  problem_ = problemOf(*map, stop);
  map_ = map;
  return problem_;
}

std::string ThresholdFit::problemOf(const OccupancyGrid& map, const base::StopToken& stop) {
  const OccupancyThresholds& thresholds = thresholds_;
  Seen seen;
  // Whether there is one of the class, by the cell that was one before, or the row just seen.
  const auto is = [&](std::size_t index, Occupancy occupancy) {
    return index < map.values().size() && thresholds.classify(map.values()[index]) == occupancy;
  };
  const auto note = [&](int row, Occupancy occupancy, std::size_t& index) {
    if (seen.rangeOf(occupancy, thresholds).empty()) return false;
    const std::int8_t* at = map.row(row);
    while (thresholds.classify(*at) != occupancy) ++at;
    index = static_cast<std::size_t>(at - map.values().data());
    return true;
  };
  bool has_free = is(free_, Occupancy::FREE), has_occupied = is(occupied_, Occupancy::OCCUPIED);
  base::StopPoll poll(stop, kRowsBetweenQuestions);
  for (int row = 0; row < map.height() && !(has_free && has_occupied); ++row) {
    poll();
    for (int column = 0; column < map.width(); ++column) seen.add(map.row(row)[column]);
    has_free = has_free || note(row, Occupancy::FREE, free_);
    has_occupied = has_occupied || note(row, Occupancy::OCCUPIED, occupied_);
  }
  if (has_free && has_occupied) return "";
  const Seen::Range between = seen.rangeOf(Occupancy::UNKNOWN, thresholds);
  return between.empty() ? "" : textOf(has_free, has_occupied, between, thresholds);
}

bool isInflated(const std::vector<std::int8_t>& values, std::size_t width) {
  const auto isLower = [&](std::size_t index) {
    return values[index] >= 0 && values[index] < kInscribed;
  };
  bool has_lethal = false, has_inscribed = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    has_inscribed = has_inscribed || values[i] == kInscribed;
    if (values[i] != kLethal) continue;
    has_lethal = true;
    const std::size_t column = i % width;
    if ((column > 0 && isLower(i - 1)) || (column + 1 < width && isLower(i + 1)) ||
        (i >= width && isLower(i - width)) || (i + width < values.size() && isLower(i + width)))
      return false;
  }
  return has_lethal && has_inscribed;
}

}  // namespace grid_path_planner::grid
