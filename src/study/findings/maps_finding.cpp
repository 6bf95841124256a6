#include <array>

#include "study/findings/finding_text.h"
#include "study/findings/findings.h"

namespace grid_path_planner::study {

using grid::Cell, grid::Occupancy, grid::OccupancyGrid, grid::OccupancyThresholds;

ClassShares classSharesOf(const OccupancyGrid& map, const OccupancyThresholds& thresholds) {
  std::array<std::size_t, 3> counts{};
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < map.geometry().width(); ++column)
      ++counts[static_cast<std::size_t>(thresholds.classify(map[Cell{column, row}]))];
  const auto share = [&](Occupancy occupancy) {
    return static_cast<double>(counts[static_cast<std::size_t>(occupancy)]) /
           static_cast<double>(map.geometry().size());
  };
  return {share(Occupancy::FREE), share(Occupancy::UNKNOWN), share(Occupancy::OCCUPIED)};
}

Finding mapsFinding(const StudyData& data) {
  Finding finding;
  finding.question = "What do the maps hold?";
  finding.table = {
      "maps",
      "Shares of the cells of the full map. Weights of unknown cells can only show on "
      "a map that has such cells.",
      {"map", "columns", "rows", "cell [m]", "free [%]", "unknown [%]", "occupied [%]"},
      {}};
  for (std::size_t i = 0; i < data.study().maps.size(); ++i) {
    const OccupancyGrid& map = *data.plan().map(i);
    const ClassShares shares = classSharesOf(map, data.study().base.costmap.thresholds);
    finding.table.rows.push_back(
        {data.study().maps[i].name, TableCell(map.geometry().width(), 6),
         TableCell(map.geometry().height(), 6), TableCell(map.geometry().resolution(), 3),
         TableCell(100.0 * shares.free, 3), TableCell(100.0 * shares.unknown, 3),
         TableCell(100.0 * shares.occupied, 3)});
  }
  return finding;
}

}  // namespace grid_path_planner::study
