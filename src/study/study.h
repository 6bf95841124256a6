// A study: maps x settings of the costmap x queries, and on each of these every planner with every
// heuristic and tie-break.
//
//   Study study = readStudyFile("config/study_thesis.yaml");
//
// A *setting* defines the problem (map, kernel, rule, weights), a *variant* solves it
// (planner, heuristic, tie-break). Variants are compared on the same setting and query, never
// across.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/grid/cell.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::study {

struct CellPair {
  grid::Cell start;
  grid::Cell goal;
};

// The sources of the queries on a map; all given ones are used, in this order.
struct QuerySource {
  std::vector<CellPair> pairs;  // cells of the full map
  int random_count = 0;         // pairs of free cells, of which one can be reached from the other
  std::uint32_t random_seed = 1;
  std::string scenario;    // MovingAI .scen, "" for none
  int scenario_limit = 0;  // spread evenly over the file; 0: all

  bool empty() const { return pairs.empty() && random_count == 0 && scenario.empty(); }
};

struct StudyMap {
  std::string name;
  std::string file;
  QuerySource queries;
};

struct Weights {
  int free = 1;
  int unknown = 50;
  int occupied = 100;
};

struct StudyVariant {
  std::string label;  // "a_star octile"
  std::string planner;
  planners::SearchOptions search;
  bool published_cross = false;  // as of makeStudyPlanner()
};

struct StudySetting {
  std::string label;  // "dexrov_site, kernel 3 filter2d, weights 1/50/100"
  std::size_t map = 0;
  std::string weights;  // "1/50/100"
  costmap::CostmapOptions costmap;
};

// Published figures of the same comparison, shown beside the measured ones.
struct PublishedFigures {
  std::string source;                                   // "" where nothing was published
  std::map<std::string, std::map<int, double>> time_s;  // by variant and kernel
  double expanded_ratio = 0.0;                          // Dijkstra's over A*'s; 0: not published
  std::map<std::string, double> shortest_percent;       // by heuristic
  std::map<std::string, double> alone_percent;          // by heuristic: shortest, and no other is
  std::map<std::string, std::string> crossing;          // by weights: "unknown" or "occupied"
  bool dijkstra_not_optimal = false;                    // whether that was concluded
};

struct Study {
  std::string file;
  std::string title;
  std::vector<StudyMap> maps;
  std::vector<StudySetting> settings;
  std::vector<StudyVariant> variants;
  planning::PlannerOptions base;  // options that settings and variants do not set
  int repeats = 5;                // of each run, for its time
  PublishedFigures published;
};

// File names in it are relative to its folder. Throws InputError naming the file and the line for
// unknown keys, planners and options, empty lists, and the same entry twice.
Study readStudyFile(const std::string& file);

}  // namespace grid_path_planner::study
