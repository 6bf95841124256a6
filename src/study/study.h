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
  std::string group;  // of pairs under a name of their own, "" for none
  int number = 0;     // in its group, from 1
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

// What the blocks of a kernel get whose middle lies outside the map, in the last columns and rows:
// what the kernel's rule says, or nothing, as in the original study, where they stayed free as its
// downsampled map was made.
enum class Border { FILLED, UNFILLED };
const std::vector<std::pair<const char*, Border>>& choicesOf(Border);

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
  Border border = Border::FILLED;
  std::string weights;  // "1/50/100"
  costmap::CostmapOptions costmap;
};

// Numbers of cells of the paths of one query, by heuristic in the order of publication.
struct PublishedCells {
  std::string text;          // as published, "104/?/?"
  std::vector<int> figures;  // 0 where the page is missing
};
PublishedCells publishedCells(const std::string& text);

// Published figures of the same comparison, shown beside the measured ones.
struct PublishedFigures {
  std::string source;   // "" where nothing was published
  std::string group;    // of the pairs that `cells` and `border_cells` number
  std::string planner;  // the variants' planner that repeats the published one
  std::map<std::string, std::map<int, double>> time_s;     // by variant and kernel
  std::map<int, std::map<int, PublishedCells>> cells;      // by pair and kernel
  std::map<int, std::map<int, std::string>> border_cells;  // "61 of 128": in unfilled blocks
  std::string other_group;                                 // of the pairs of Dijkstra's cells
  std::map<int, std::map<int, std::string>> other_cells;   // by pair and kernel
  std::map<std::string, double> shortest_percent;          // by heuristic
  std::map<std::string, double> alone_percent;             // by heuristic: and no other is
  std::map<std::string, std::string> crossing;             // by weights: "unknown", "occupied"
  bool conclusions = false;  // whether the original study's nine conclusions get verdicts
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
