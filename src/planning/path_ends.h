// The cells between which a path is searched for the two poses of a request, and the reason where
// there is none.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "grid_path_planner/planning/path_planner.h"
#include "planning/end_segments.h"
#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

// One end of a path: the cell that is searched from, and the position where the path ends.
struct PathEnd {
  grid::Cell cell;
  Eigen::Vector2d position;
  std::string note;    // what the plan's message adds about it, "" if nothing
  bool moved = false;  // the cell is not that of the requested pose
  std::optional<Eigen::Vector2d> escape = {};  // where the line out of a blocked start ends
};

class PathEnds {
 public:
  // What is wrong with a pose; "" where nothing is.
  using Complaint = std::function<std::string(const path::Pose&)>;

  // `costs` is the costmap at full resolution, for which `search` is prepared. The path ends at no pose that
  // `complaint` has words for, unless it is null. All outlive this.
  PathEnds(const PoseRequest& request, const PlannerOptions& options,
           const costmap::CostGrid& costs, MultiResolutionPlanner& search,
           const base::StopToken& stop, const Complaint& complaint = {})
      : request_(request),
        options_(options),
        costs_(costs),
        segments_(costs),
        search_(search),
        stop_(stop),
        complaint_(complaint) {}

  // None where `failure` says why. A blocked start is left for the nearest passable cell within
  // start_escape_radius to which a line leads out of it (start_escape.h); where there is none, for the
  // nearest point between two or four of them. A blocked goal is replaced by substituteGoal(). Where distances are kept, the cell is the nearest one to whose centre a straight
  // line keeps them. Throw Stopped.
  std::optional<PathEnd> start(Plan& failure) const;
  std::optional<PathEnd> goal(const PathEnd& start, Plan& failure) const;

  // For a blocked start: the nearest of these cells from which `goal` can be reached.
  std::optional<PathEnd> escapeTowards(const PathEnd& goal) const;
  // The cell nearest the goal, within the tolerance, that can be reached from `start`. `why` the
  // goal itself is not used goes into the note.
  std::optional<PathEnd> substituteGoal(const PathEnd& start, const std::string& why) const;

 private:
  template <class Usable>
  std::optional<PathEnd> escapeStart(Usable&& usable) const;
  template <class Legal>
  std::optional<grid::Cell> joinedCell(const Eigen::Vector2d& position, Legal&& legal) const;
  std::optional<PathEnd> measuredStart(const Eigen::Vector2d& position) const;
  std::optional<PathEnd> measuredGoal(const Eigen::Vector2d& position, std::string& why) const;
  // Where a line out of a start ends, beside the centre of a passable cell or there.
  struct Escape {
    grid::Cell cell;
    Eigen::Vector2d point;
    double length;  // m
  };

  template <class Usable>
  std::optional<Escape> nearestEscape(const Eigen::Vector2d& position, double radius,
                                      Usable&& usable) const;
  costmap::KeptDistances leastDistances() const;
  std::string noEscapeText(const Eigen::Vector2d& position) const;
  std::string escapeText(const Eigen::Vector2d& position) const;
  bool closed(grid::Occupancy occupancy) const;
  std::string whyBlocked(grid::Cell cell) const;
  // "is 0.2 m from an unknown cell, nearer than ..."; "" at a position that keeps all distances.
  std::string tooNear(const Eigen::Vector2d& position) const;
  // Of the goal at this position.
  std::string complaintAt(const Eigen::Vector2d& position) const;
  std::string outsideMap() const;

  const PoseRequest& request_;
  const PlannerOptions& options_;
  const costmap::CostGrid& costs_;
  EndSegments segments_;
  MultiResolutionPlanner& search_;
  const base::StopToken& stop_;
  const Complaint complaint_;
};

}  // namespace grid_path_planner::planning
