#include "study/study_query.h"

#include <random>
#include <sstream>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/reachable_cells.h"
#include "grid_path_planner/planning/nearest_cell.h"
#include "grid_path_planner/study/scenario_file.h"

namespace grid_path_planner::study {

using base::InputError, base::StopToken;
using costmap::CostGrid, costmap::CostmapBuilder, costmap::CostmapOptions;
using grid::Cell, grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid,
    grid::OccupancyThresholds;
using planners::reachableFrom;
using planning::nearestCell;

namespace {

constexpr int kMostDraws = 1000;  // of starts from which nothing was reached

std::string text(Cell cell) {
  std::ostringstream out;
  out << cell;
  return out.str();
}

// The map at full resolution, with occupied cells blocked whatever the study lets pass.
std::shared_ptr<const CostGrid> strictCosts(const OccupancyGrid& occupancy,
                                            CostmapOptions options) {
  options.occupied_is_passable = false;
  options.kernel = 1;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(occupancy));
  return builder.fullResolution(StopToken());
}

class QueryMaker {
 public:
  QueryMaker(const StudyMap& map, const OccupancyGrid& occupancy, const CostmapOptions& costmap)
      : map_(map),
        occupancy_(occupancy),
        thresholds_(costmap.thresholds),
        costs_(strictCosts(occupancy, costmap)) {}

  std::vector<StudyQuery> make() {
    for (const CellPair& pair : map_.queries.pairs) {
      add(pair.start, pair.goal);
      queries_.back().group = pair.group;
      queries_.back().number = pair.number;
    }
    addRandom();
    addScenario();
    return queries_;
  }

 private:
  bool free(Cell cell) const {
    return costs_->passable(cell) && thresholds_.classify(occupancy_[cell]) == Occupancy::FREE;
  }

  // `cell`, or the free cell nearest to it where it is blocked, which `note` then tells.
  Cell freeCellNear(Cell cell, const std::string& which, std::string& note) const {
    const GridGeometry& geometry = occupancy_.geometry();
    if (!geometry.contains(cell))
      throw InputError(map_.file, "the " + which + ' ' + text(cell) +
                                      " of a query is outside its " +
                                      std::to_string(geometry.width()) + "x" +
                                      std::to_string(geometry.height()) + " cells");
    if (costs_->passable(cell)) return cell;
    const double everywhere = geometry.resolution() * (geometry.width() + geometry.height());
    const auto nearest = nearestCell(geometry, geometry.centre(cell), everywhere,
                                     [this](Cell each) { return free(each); });
    if (!nearest) throw InputError(map_.file, "has no free cell to start from or to go to");
    note += (note.empty() ? "" : "; ") + which + ' ' + text(cell) + " is blocked, " +
            text(nearest->cell) + " taken";
    return nearest->cell;
  }

  void add(Cell start, Cell goal) {
    StudyQuery query;
    query.start = freeCellNear(start, "start", query.note);
    query.goal = freeCellNear(goal, "goal", query.note);
    queries_.push_back(query);
  }

  std::vector<Cell> freeCells() const {
    std::vector<Cell> cells;
    const GridGeometry& geometry = occupancy_.geometry();
    for (int row = 0; row < geometry.height(); ++row)
      for (int column = 0; column < geometry.width(); ++column)
        if (free({column, row})) cells.push_back({column, row});
    return cells;
  }

  void addRandom() {
    if (map_.queries.random_count == 0) return;
    const std::vector<Cell> cells = freeCells();
    if (cells.size() < 2) throw InputError(map_.file, "has no two free cells for random queries");
    std::mt19937 random(map_.queries.random_seed);
    // Not std::uniform_int_distribution, whose numbers differ between standard libraries.
    const auto any = [&] { return cells[random() % cells.size()]; };
    int draws = 0;
    for (int made = 0; made < map_.queries.random_count;) {
      if (++draws > kMostDraws + map_.queries.random_count)
        throw InputError(map_.file, "has too few connected free cells for random queries");
      if (addFrom(any(), any)) ++made;
    }
  }

  // Adds a query to one of a few drawn cells; false where none is reached, as in a small pocket.
  template <class Draw>
  bool addFrom(Cell start, Draw&& draw) {
    const std::vector<std::uint8_t> reached = reachableFrom(*costs_, start, StopToken());
    for (int tries = 0; tries < 20; ++tries) {
      const Cell goal = draw();
      if (reached[occupancy_.geometry().index(goal).value()] == 0 || goal == start) continue;
      queries_.push_back({start, goal, "", 0, ""});
      return true;
    }
    return false;
  }

  void addScenario() {
    if (map_.queries.scenario.empty()) return;
    const std::vector<ScenarioQuery> all = readScenarioFile(map_.queries.scenario);
    const auto limit = static_cast<std::size_t>(map_.queries.scenario_limit);
    const GridGeometry& geometry = occupancy_.geometry();
    for (const ScenarioQuery& query : spreadOver(all, limit)) {
      checkScenarioQuery(query, geometry, map_.queries.scenario);
      add(query.start, query.goal);
    }
  }

  const StudyMap& map_;
  const OccupancyGrid& occupancy_;
  OccupancyThresholds thresholds_;
  std::shared_ptr<const CostGrid> costs_;
  std::vector<StudyQuery> queries_;
};

}  // namespace

std::vector<StudyQuery> studyQueries(const StudyMap& map, const OccupancyGrid& occupancy,
                                     const CostmapOptions& costmap) {
  return QueryMaker(map, occupancy, costmap).make();
}

}  // namespace grid_path_planner::study
