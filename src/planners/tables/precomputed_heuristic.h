// The heuristics from tables, landmark and exact, for a search that uses one of them or none.
//
//   PrecomputedHeuristic tables(options);
//   tables.prepare(map);
//   SearchResult result = tables.withBound(goal, [&](const auto& boundIn) {
//     const auto bound = boundIn(scale);
//     return search(bound(index));  // a key of that scale
//   });
//
// A bound is 0 everywhere where the options ask for no table and while it is being made.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "planners/tables/exact_table.h"
#include "planners/tables/landmark_table.h"
#include "planners/tables/precomputed_table.h"

namespace grid_path_planner::planners {

struct NoBound {
  SearchKey operator()(std::uint32_t) const { return 0; }
};

class PrecomputedHeuristic {
 public:
  explicit PrecomputedHeuristic(const AStarOptions& options);

  // Two tables at most: one in use while the next is made.
  static std::size_t bytesFor(const AStarOptions& options, const grid::GridGeometry& geometry);
  // What a user can do where that is too much; "" where the heuristic needs no table.
  static std::string lessMemoryAdvice(const AStarOptions& options);

  // As those of PrecomputedTable; nothing where there is no table to make.
  void prepare(std::shared_ptr<const costmap::CostGrid> map);
  void update(const costmap::CostGrid& before, std::shared_ptr<const costmap::CostGrid> map,
              const std::vector<grid::CellRect>& changed);
  void wait(const base::StopToken& stop) const;
  BackgroundWork work();

  // Whether there is a table that can be used.
  bool ready() { return (landmarks_ && landmarks_->ready()) || (exact_ && exact_->ready()); }

  // The bound to the cell `goal` by landmarks, where there is a table of them that can be used.
  std::optional<LandmarkBound> landmarkBound(std::uint32_t goal, const KeyScale& scale) {
    const LandmarkTable* table = landmarks_ ? landmarks_->ready() : nullptr;
    if (!table || table->landmarks().empty()) return std::nullopt;
    return LandmarkBound(*table, landmarks_->decreases(), goal, scale);
  }

  // What `search(boundIn)` gives, with the bounds to the cell `goal`.
  template <class Search>
  auto withBound(std::uint32_t goal, Search&& search) {
    if (landmarkBound(goal, kWideScale))
      return search([&](const KeyScale& scale) { return *landmarkBound(goal, scale); });
    if (exact_)
      if (const ExactTable* table = exact_->ready())
        return search([&](const KeyScale& scale) {
          return ExactBound(*table, exact_->decreases(), goal, scale);
        });
    return search([](const KeyScale&) { return NoBound(); });
  }

 private:
  std::unique_ptr<PrecomputedTable<LandmarkTable>> landmarks_;
  std::unique_ptr<PrecomputedTable<ExactTable>> exact_;
};

}  // namespace grid_path_planner::planners
