// The original study's programs, by examples worked by hand, by a second writing of the listing, and by
// the laws that hold of them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "study/programs/published_dijkstra.h"
#include "study/study_planners.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/error_text.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::study {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapOptions;
using costmap::DiagonalCost;
using grid::Cell;
using grid::Occupancy;
using planners::Heuristic;
using planners::SearchOptions;
using planners::SearchResult;

namespace {

using test::AsciiMap;
using test::costsOf;
using test::errorText;

using RowColumn = std::pair<int, int>;  // the original's

// The original's row is our column: what is drawn in its rows is turned over its diagonal.
std::vector<std::string> turned(const std::vector<std::string>& rows) {
  std::vector<std::string> lines(rows.front().size(), std::string(rows.size(), ' '));
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t column = 0; column < rows[row].size(); ++column)
      lines[column][row] = rows[row][column];
  return lines;
}

CostmapOptions asPublished(bool occupied_is_passable) {
  CostmapOptions options;
  options.occupied_is_passable = occupied_is_passable;
  options.unknown_weight = 5;
  options.occupied_weight = 7;
  options.motion.diagonal_cost = DiagonalCost::UNIT;
  options.motion.cut_corners = true;
  return options;
}

SearchOptions guidedBy(Heuristic heuristic) {
  SearchOptions options;
  options.heuristic = heuristic;
  options.heuristic_scale = "1";
  return options;
}

struct Answer {
  SearchResult result;
  std::vector<RowColumn> path;
};

Answer answerOn(const std::shared_ptr<const CostGrid>& map, const std::string& planner, Cell start,
                Cell goal, const SearchOptions& options, bool cross = false) {
  const auto program = makeStudyPlanner(planner, options, cross);
  program->prepare(map, StopToken());
  Answer answer{program->search({start, {goal}, false}, StopToken()), {}};
  for (const Cell cell : answer.result.cells) answer.path.emplace_back(cell.column, cell.row);
  return answer;
}

Answer answer(const std::string& planner, const std::vector<std::string>& rows,
              bool occupied_is_passable = false) {
  const AsciiMap picture(turned(rows));
  return answerOn(costsOf(picture.map, asPublished(occupied_is_passable)), planner, picture.start,
                  picture.goal, guidedBy(Heuristic::EUCLIDEAN));
}

// --- a_star_published: worked by hand -----------------------------------------------------------

// f of the start's neighbours: (1,1) 1 + 2 = 3; (0,1) and (2,1) 1 + 2.24, cut to 3; (0,0) and (2,0)
// 1 + 3.16, cut to 4. Of the three with 3 the smallest row is taken, (0,1), though (1,1) lies on the
// line; it adds (0,2) 2 + 1.41 and (1,2) 2 + 1, both 3. Again the smaller row, (0,2), is taken; it
// adds (0,3) and generates the goal, which ends the search.
TEST(PublishedAStar, TakesTheSmallerRowWhereTheCutFIsTheSame) {
  const Answer found = answer("a_star_published", {"....",  //
                                                   "S..G",  //
                                                   "...."});
  EXPECT_EQ(found.path, (std::vector<RowColumn>{{1, 0}, {0, 1}, {0, 2}, {1, 3}}));
  EXPECT_EQ(found.result.statistics.expanded, 3u) << "(1,0), (0,1), (0,2)";
  EXPECT_EQ(found.result.statistics.generated, 9u) << "the start, five, two and one";
}

// (0,1) is unknown and weighs 5: f = 5 + 1. Around it, (1,0) has 1 + 2.24, (2,0) 2 + 2.83 and
// (3,0) 3 + 3.61, cut to 6: the tie goes to the smaller row, (0,1), which generates the goal. That
// path costs 10; the one around costs 8.
TEST(PublishedAStar, EndsWhenTheGoalIsGenerated) {
  const std::vector<std::string> rows = {"S?G",  //
                                         ".#.",  //
                                         ".#.",  //
                                         ".#.",  //
                                         "..."};
  const Answer found = answer("a_star_published", rows);
  EXPECT_EQ(found.path, (std::vector<RowColumn>{{0, 0}, {0, 1}, {0, 2}}));
  EXPECT_EQ(found.result.costValue(), 10.0);
  EXPECT_EQ(found.result.statistics.expanded, 4u) << "(0,0), (1,0), (2,0), (0,1)";
  EXPECT_EQ(answer("a_star", rows).result.costValue(), 8.0) << "the correct one";
}

// A step costs the larger of two cells: (0,1) 5 + 2, then (0,2) 10 + 1. The path around costs 9. A
// step that costs the cell entered: (0,2) 6 + 1 is taken before any cell of that with f 7.
TEST(PublishedAStar, CostsTheLargerOfTwoCellsOrTheOneEntered) {
  const std::vector<std::string> rows = {"S?.G",  //
                                         ".##.",  //
                                         ".##.",  //
                                         ".##.",  //
                                         "...."};
  EXPECT_EQ(answer("a_star_published", rows).path,
            (std::vector<RowColumn>{
                {0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 1}, {4, 2}, {3, 3}, {2, 3}, {1, 3}, {0, 3}}));
  EXPECT_EQ(answer("a_star_published_values", rows).path,
            (std::vector<RowColumn>{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
}

TEST(PublishedAStar, SkipsOccupiedCellsAsListedOrCrossesThemAsTheTextDoes) {
  EXPECT_EQ(answer("a_star_published", {"S#.G"}, true).result.status, Status::UNREACHABLE);
  const Answer through = answer("a_star_published_crossing", {"S#.G"}, true);
  EXPECT_EQ(through.path, (std::vector<RowColumn>{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
  EXPECT_EQ(through.result.costValue(), 15.0) << "7 in, 7 out, 1";
  EXPECT_EQ(answer("a_star_published_crossing", {"S#.G"}, false).result.status, Status::UNREACHABLE)
      << "where the map blocks them nobody crosses";
}

// With the start at (2,0) and the goal at (2,4), dx2 = 0 and dy2 = -4, so h is 0.001 (row - 2)(-4):
// below the line it is negative. f = 1 - 0.004 is cut to 0 and taken before f = 1. A row below the
// line all f are one less than on it, so the path runs there.
TEST(PublishedAStar, TheCrossProductIsSignedAndAlone) {
  const AsciiMap picture(turned({".....",  //
                                 ".....",  //
                                 "S...G",  //
                                 ".....",  //
                                 "....."}));
  const Answer found = answerOn(costsOf(picture.map, asPublished(true)), "a_star_published",
                                picture.start, picture.goal, guidedBy(Heuristic::EUCLIDEAN), true);
  ASSERT_EQ(found.path.size(), 5u);
  for (std::size_t i = 1; i + 1 < found.path.size(); ++i) EXPECT_GT(found.path[i].first, 2) << i;
}

TEST(PublishedAStar, TheCrossProductIs1000InOccupiedCells) {
  const AsciiMap picture(turned({"S#G",  //
                                 ".#.",  //
                                 ".#.",  //
                                 ".#.",  //
                                 ".#.",  //
                                 "..."}));
  const auto map = costsOf(picture.map, asPublished(true));
  const auto cost = [&](bool cross) {
    return answerOn(map, "a_star_published_crossing", picture.start, picture.goal,
                    guidedBy(Heuristic::ZERO), cross)
        .result.costValue();
  };
  EXPECT_EQ(cost(true), 10.0) << "around the wall, since its cells seem to cost 1000 more";
  EXPECT_EQ(cost(false), 14.0) << "through it: (0,1) with f 7 generates the goal";
}

// --- dijkstra_published: worked by hand ---------------------------------------------------------

// (0,0) settles (0,1), (1,0) and (1,1) at 1. Of these the first, (0,1), is settled and gives (0,2) and
// (1,2) 2; nobody improves them. The goal's parent is (0,1), and all six cells are settled.
TEST(PublishedDijkstra, SettlesTheFirstOfEquallyNearCellsAndThenAll) {
  const Answer found = answer("dijkstra_published", {"S.G",  //
                                                     "..."});
  EXPECT_EQ(found.path, (std::vector<RowColumn>{{0, 0}, {0, 1}, {0, 2}}));
  EXPECT_EQ(found.result.statistics.expanded, 6u);
  EXPECT_EQ(found.result.statistics.generated, 6u);
}

TEST(PublishedDijkstra, GoesAroundWhereThatIsCheaper) {
  const Answer found = answer("dijkstra_published", {"S?G",  //
                                                     ".#.",  //
                                                     ".#.",  //
                                                     ".#.",  //
                                                     "..."});
  EXPECT_EQ(found.result.costValue(), 8.0);
  EXPECT_EQ(found.path.size(), 9u);
  EXPECT_EQ(found.result.statistics.expanded, 12u) << "every cell that is not blocked";
}

TEST(PublishedDijkstra, ItsMatrixOfTheFullMapHas70Gigabytes) {
  EXPECT_NEAR(PublishedDijkstra::matrixBytes(366 * 362), 70.2e9, 0.05e9);
}

// --- laws on random maps ------------------------------------------------------------------------

// The listing once more, by tables of rows and columns and without a set: the open cell with the
// least (f, row, column) is looked for among all.
class Listing {
 public:
  Listing(const CostGrid& map, bool skips) : map_(map), skips_(skips) {}

  std::vector<RowColumn> path(RowColumn start, RowColumn goal) {
    std::map<RowColumn, std::int64_t> open = {{start, 0}};  // by f
    std::map<RowColumn, std::int64_t> g = {{start, 0}};
    std::map<RowColumn, RowColumn> parents;
    std::set<RowColumn> closed;
    while (!open.empty()) {
      auto best = open.begin();
      for (auto each = open.begin(); each != open.end(); ++each)
        if (each->second < best->second) best = each;
      const RowColumn at = best->first;
      open.erase(best);
      closed.insert(at);
      for (const auto& [rows, columns] : kOrder) {
        const RowColumn to = {at.first + rows, at.second + columns};
        const Cell cell{to.first, to.second};
        if (!map_.passable(cell)) continue;
        if (to == goal) return back(parents, start, at, goal);
        if (closed.count(to) != 0) continue;
        if (skips_ && map_.occupancy(cell) == Occupancy::OCCUPIED) continue;
        const std::int64_t cost =
            g[at] + std::max(map_.weight(cell), map_.weight(Cell{at.first, at.second}));
        if (g.count(to) != 0 && g[to] <= cost) continue;
        g[to] = cost;
        parents[to] = at;
        const double h = std::hypot(to.first - goal.first, to.second - goal.second);
        open[to] = static_cast<std::int64_t>(std::floor(static_cast<double>(cost) + h));
      }
    }
    return {};
  }

 private:
  static constexpr std::pair<int, int> kOrder[8] = {{-1, 0}, {1, 0},   {0, 1}, {0, -1},
                                                    {-1, 1}, {-1, -1}, {1, 1}, {1, -1}};

  static std::vector<RowColumn> back(const std::map<RowColumn, RowColumn>& parents, RowColumn start,
                                     RowColumn at, RowColumn goal) {
    std::vector<RowColumn> path = {goal};
    for (; at != start; at = parents.at(at)) path.push_back(at);
    path.push_back(start);
    return {path.rbegin(), path.rend()};
  }

  const CostGrid& map_;
  bool skips_;
};

struct RandomQuery {
  std::shared_ptr<const CostGrid> map;
  Cell start;
  Cell goal;
};

// All three classes, with ends that are free.
RandomQuery randomQuery(std::mt19937& random) {
  const int width = 5 + static_cast<int>(random() % 20),
            height = 5 + static_cast<int>(random() % 20);
  std::vector<std::string> lines(static_cast<std::size_t>(height),
                                 std::string(static_cast<std::size_t>(width), '.'));
  for (std::string& line : lines)
    for (char& letter : line) letter = "....??##"[random() % 8];
  const auto any = [&] {
    return Cell{static_cast<int>(random() % static_cast<unsigned>(width)),
                static_cast<int>(random() % static_cast<unsigned>(height))};
  };
  const Cell start = any(), goal = any();
  for (const Cell end : {start, goal})
    lines[static_cast<std::size_t>(end.row)][static_cast<std::size_t>(end.column)] = '.';
  return {costsOf(AsciiMap(lines).map, asPublished(true)), start, goal};
}

TEST(PublishedAStarLaw, IsTheListingWrittenASecondTime) {
  std::mt19937 random(2019);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const RandomQuery query = randomQuery(random);
    if (query.start == query.goal) continue;
    for (const bool skips : {true, false}) {
      const char* name = skips ? "a_star_published" : "a_star_published_crossing";
      const Answer ours =
          answerOn(query.map, name, query.start, query.goal, guidedBy(Heuristic::EUCLIDEAN));
      EXPECT_EQ(ours.path, Listing(*query.map, skips)
                               .path({query.start.column, query.start.row},
                                     {query.goal.column, query.goal.row}))
          << "trial " << trial << ' ' << name;
      found += ours.path.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(found, 400);
}

TEST(PublishedDijkstraLaw, CostsTheLeast) {
  std::mt19937 random(1959);
  for (int trial = 0; trial < 100; ++trial) {
    const RandomQuery query = randomQuery(random);
    const auto least = test::referenceCosts(
        *query.map, query.start)[query.map->geometry().index(query.goal).value()];
    const Answer found = answerOn(query.map, "dijkstra_published", query.start, query.goal, {});
    ASSERT_EQ(found.result.status, Status::FOUND) << "nothing is blocked: trial " << trial;
    ASSERT_TRUE(least.has_value());
    EXPECT_EQ(found.result.cost, *least) << "trial " << trial;
  }
}

TEST(PublishedAStarLaw, NeverCostsLessThanTheLeastAndSometimesMore) {
  std::mt19937 random(1968);
  int costlier = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RandomQuery query = randomQuery(random);
    const auto least = test::referenceCosts(
        *query.map, query.start)[query.map->geometry().index(query.goal).value()];
    const Answer found = answerOn(query.map, "a_star_published_crossing", query.start, query.goal,
                                  guidedBy(Heuristic::EUCLIDEAN));
    ASSERT_EQ(found.result.status, Status::FOUND) << "trial " << trial;
    EXPECT_FALSE(found.result.cost < *least) << "trial " << trial;
    costlier += *least < found.result.cost ? 1 : 0;
  }
  EXPECT_GT(costlier, 0);
}

// --- what they refuse ---------------------------------------------------------------------------

TEST(PublishedPrograms, RefuseMapsThatTheOriginalHadNot) {
  const auto map = costsOf(AsciiMap({"S.G"}).map);
  for (const char* name : {"a_star_published", "dijkstra_published"}) {
    const Answer refused = answerOn(map, name, {0, 0}, {2, 0}, guidedBy(Heuristic::ZERO));
    EXPECT_EQ(refused.result.status, Status::INVALID_REQUEST) << name;
    EXPECT_TRUE(test::contains(refused.result.message, "diagonal_cost unit")) << name;
  }
}

TEST(PublishedPrograms, RefuseOptionsThatTheyDoNotHave) {
  SearchOptions tables = guidedBy(Heuristic::EXACT);
  EXPECT_NE(errorText([&] { makeStudyPlanner("a_star_published", tables, false); }), "");
  for (const char* name : {"a_star", "dijkstra_published", "theta_star"})
    EXPECT_TRUE(test::contains(errorText([&] { makeStudyPlanner(name, {}, true); }),
                               "cross_product_published"))
        << name;
}

}  // namespace
}  // namespace grid_path_planner::study
