// A planner of one's own, used by PathPlanner like those of the library.
//
// A planner derives from Planner, says in its traits what it can, and implements bytesFor() and
// doSearch(). The base class has checked the request by then: start and goal are passable cells of
// a map that the traits allow. Every loop whose length depends on the map asks the stop token.
#include <iostream>
#include <memory>
#include <queue>

#include "grid_path_planner/planning/path_planner.h"
#include "text_map.h"

using namespace grid_path_planner::base;
using namespace grid_path_planner::grid;
using namespace grid_path_planner::planners;
using namespace grid_path_planner::planning;

namespace {

// Breadth-first search from the goal over the four neighbours of a cell: fewest steps, whatever
// cells weigh.
class BreadthFirst : public Planner {
 public:
  BreadthFirst() : Planner(PlannerTraits{"breadth_first"}) {}

  std::size_t bytesFor(const GridGeometry& geometry) const override {
    return geometry.size() * 2 * sizeof(Cell);  // the parents, and all cells in the queue
  }

 private:
  SearchResult doSearch(const SearchRequest& request, const StopToken& stop) override {
    constexpr Cell kNone = {-1, -1};
    Grid<Cell> parents(map().geometry(), kNone);
    parents[request.goals[0]] = request.goals[0];
    SearchResult result;
    StopPoll poll(stop);
    std::queue<Cell> open({request.goals[0]});
    for (; !open.empty() && open.front() != request.start; open.pop()) {
      poll();  // throws where the search must stop: TIMEOUT or CANCELLED
      ++result.statistics.expanded;
      for (const Cell step : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}}) {
        const Cell to = {open.front().column + step.column, open.front().row + step.row};
        if (!map().passable(to) || parents[to] != kNone) continue;
        parents[to] = open.front();
        open.push(to);
      }
    }
    result.status = open.empty() ? Status::UNREACHABLE : Status::FOUND;
    if (open.empty()) return result;
    for (Cell cell = request.start; cell != request.goals[0]; cell = parents[cell])
      result.cells.push_back(cell);
    result.cells.push_back(request.goals[0]);
    result.cost = costOfSteps(map(), result.cells);
    return result;
  }
};

std::unique_ptr<Planner> makeAny(const std::string& name, const SearchOptions& options) {
  if (name == "breadth_first") return std::make_unique<BreadthFirst>();
  return makePlanner(name, options);
}

}  // namespace

int main() {
  const auto map = std::make_shared<const OccupancyGrid>(
      examples::mapOf({"..............", "....##........", ".....#..####..", ".....#..#.....",
                       ".....????.....", ".....????....."}));
  PlannerOptions options;
  options.smooth = false;  // the searches themselves are compared
  for (const char* name : {"breadth_first", "a_star"}) {
    options.planner = name;
    PathPlanner planner(options, makeAny);
    planner.setMap(map);
    const Plan plan = planner.plan({{{0.5, 0.5, 0.0}, 0.0}, {{13.5, 0.5, 0.0}, 0.0}});
    std::cout << name << ": " << toString(plan.status) << ", " << plan.path.poses.size()
              << " cells, cost " << plan.costValue() << '\n';
    if (plan.status != Status::FOUND) return 1;
    examples::print(*map, plan.path);
  }
}
