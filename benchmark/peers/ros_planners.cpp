// The planners inside navfn and global_planner, without a node: what engine_table measures beside ours.
//
//   ros_planners --alg navfn_astar|gp_astar --scen FILE --map FILE [--costs FILE]
//   ros_planners --alg navfn_potential --costs FILE --goal X,Y
//
// The first prints a line a query: its index, nanoseconds of potential and path (steady clock), 1 if a path was found, its
// length in cells. The second propagates over the whole map and prints 0, nanoseconds, labelled cells, open cells.
// --costs: a binary PGM with costmap_2d's values, in the rows of the map; without it the map's free cells are 0, others 254.
// As in their nodes, the map's border is blocked, and options are their defaults; diagonals may cut corners.
#include <global_planner/astar.h>
#include <global_planner/gradient_path.h>
#include <global_planner/quadratic_calculator.h>
#include <navfn/navfn.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr unsigned char kLethal = 254;

struct Costs {
  int width = 0, height = 0;
  std::vector<unsigned char> values;
};

struct Query {
  int start_x, start_y, goal_x, goal_y;
};

using Path = std::vector<std::pair<float, float>>;

std::ifstream opened(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + name + "'");
  return file;
}

Costs costsOfPgm(const std::string& name) {
  std::ifstream file = opened(name);
  std::string magic;
  int largest = 0;
  Costs costs;
  if (!(file >> magic >> costs.width >> costs.height >> largest) || magic != "P5" || largest != 255)
    throw std::runtime_error("'" + name + "' is no binary PGM of 8 bits without comments");
  file.get();
  costs.values.resize(static_cast<std::size_t>(costs.width) * costs.height);
  file.read(reinterpret_cast<char*>(costs.values.data()),
            static_cast<std::streamsize>(costs.values.size()));
  if (!file) throw std::runtime_error("'" + name + "' ends early");
  return costs;
}

Costs costsOfMap(const std::string& name) {
  std::ifstream file = opened(name);
  Costs costs;
  std::string word;
  while (file >> word && word != "map") {
    if (word == "height") file >> costs.height;
    if (word == "width") file >> costs.width;
  }
  for (char cell; file >> cell;)
    costs.values.push_back(cell == '.' || cell == 'G' || cell == 'S' ? 0 : kLethal);
  if (costs.values.size() != static_cast<std::size_t>(costs.width) * costs.height)
    throw std::runtime_error("'" + name + "' is no MovingAI map");
  return costs;
}

void blockBorder(Costs& costs) {
  for (int y = 0; y < costs.height; ++y)
    for (int x = 0; x < costs.width; ++x)
      if (x == 0 || y == 0 || x == costs.width - 1 || y == costs.height - 1)
        costs.values[static_cast<std::size_t>(y) * costs.width + x] = kLethal;
}

std::vector<Query> queriesOf(const std::string& name) {
  std::ifstream file = opened(name);
  std::vector<Query> queries;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string map;
    double bucket;
    int width, height;
    Query query{};
    if (words >> bucket >> map >> width >> height >> query.start_x >> query.start_y >>
        query.goal_x >> query.goal_y)
      queries.push_back(query);
  }
  return queries;
}

double lengthOf(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += std::hypot(path[i].first - path[i - 1].first, path[i].second - path[i - 1].second);
  return length;
}

class Navfn {
 public:
  explicit Navfn(const Costs& costs) : search_(costs.width, costs.height) {
    search_.setCostmap(costs.values.data(), true, false);
  }

  Path plan(const Query& query) {
    int goal[] = {query.goal_x, query.goal_y}, start[] = {query.start_x, query.start_y};
    search_.setGoal(goal);
    search_.setStart(start);
    if (!search_.calcNavFnAstar()) return {};
    Path path;
    for (int i = 0; i < search_.getPathLen(); ++i)
      path.emplace_back(search_.getPathX()[i], search_.getPathY()[i]);
    return path;
  }

 private:
  navfn::NavFn search_;
};

class GlobalPlanner {
 public:
  explicit GlobalPlanner(const Costs& costs)
      : costs_(costs),
        potential_(costs.values.size()),
        calculator_(costs.width, costs.height),
        search_(&calculator_, costs.width, costs.height),
        trace_(&calculator_) {
    search_.setHasUnknown(false);
    trace_.setSize(costs.width, costs.height);
  }

  Path plan(const Query& query) {
    Path path;
    const bool found = search_.calculatePotentials(
        costs_.values.data(), query.start_x, query.start_y, query.goal_x, query.goal_y,
        costs_.width * costs_.height * 2, potential_.data());
    search_.clearEndpoint(costs_.values.data(), potential_.data(), query.goal_x, query.goal_y, 2);
    if (!found || !trace_.getPath(potential_.data(), query.start_x, query.start_y, query.goal_x,
                                  query.goal_y, path))
      return {};
    return path;
  }

 private:
  Costs costs_;
  std::vector<float> potential_;
  global_planner::QuadraticCalculator calculator_;
  global_planner::AStarExpansion search_;
  global_planner::GradientPath trace_;
};

long long nanosecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() -
                                                              begin)
      .count();
}

template <class Planner>
void answer(const Costs& costs, const std::vector<Query>& queries) {
  Planner planner(costs);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const Path path = planner.plan(queries[i]);
    const long long nanoseconds = nanosecondsSince(begin);
    std::printf("%zu %lld %d %.9g\n", i, nanoseconds, path.empty() ? 0 : 1, lengthOf(path));
  }
}

void propagate(const Costs& costs, const std::string& goal_text) {
  int goal[2] = {0, 0}, start[2] = {0, 0};
  if (std::sscanf(goal_text.c_str(), "%d,%d", &goal[0], &goal[1]) != 2)
    throw std::runtime_error("--goal takes X,Y, got '" + goal_text + "'");
  navfn::NavFn search(costs.width, costs.height);
  const auto begin = std::chrono::steady_clock::now();
  search.setCostmap(costs.values.data(), true, false);
  search.setGoal(goal);
  search.setStart(start);
  search.setupNavFn(true);
  search.propNavFnDijkstra(std::numeric_limits<int>::max());
  const long long nanoseconds = nanosecondsSince(begin);
  std::size_t labelled = 0, open = 0;
  for (std::size_t i = 0; i < costs.values.size(); ++i) {
    labelled += search.potarr[i] < POT_HIGH ? 1 : 0;
    open += costs.values[i] < 253 ? 1 : 0;
  }
  std::printf("0 %lld %zu %zu\n", nanoseconds, labelled, open);
}

void run(const std::map<std::string, std::string>& given) {
  const auto value = [&](const std::string& name) {
    const auto found = given.find(name);
    if (found == given.end()) throw std::runtime_error(name + " is missing");
    return found->second;
  };
  const std::string algorithm = value("--alg");
  Costs costs =
      given.count("--costs") > 0 ? costsOfPgm(value("--costs")) : costsOfMap(value("--map"));
  blockBorder(costs);
  if (algorithm == "navfn_astar")
    answer<Navfn>(costs, queriesOf(value("--scen")));
  else if (algorithm == "gp_astar")
    answer<GlobalPlanner>(costs, queriesOf(value("--scen")));
  else if (algorithm == "navfn_potential")
    propagate(costs, value("--goal"));
  else
    throw std::runtime_error("--alg takes navfn_astar, gp_astar or navfn_potential, got '" +
                             algorithm + "'");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::map<std::string, std::string> given;
    for (int i = 1; i < argc; i += 2) {
      if (i + 1 == argc) throw std::runtime_error(std::string(argv[i]) + " has no value");
      given[argv[i]] = argv[i + 1];
    }
    run(given);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "ros_planners: " << error.what() << '\n';
    return 1;
  }
}
