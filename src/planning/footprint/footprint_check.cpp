#include "planning/footprint/footprint_check.h"

#include <cmath>

#include "path/motions.h"
#include "planning/message_text.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid, costmap::CostmapOptions, costmap::Outside;
using grid::Cell, grid::Occupancy, grid::RowSpan;
using path::motionsAlong, path::Path, path::Pose;
using vehicle::Footprint, vehicle::FootprintContact, vehicle::FootprintObstacles,
    vehicle::FootprintSweep, vehicle::Motion;

namespace {

bool unknownCounts(const CostmapOptions& options) {
  return !options.unknown_is_passable && options.radius_to_unknown < 0.0;
}

bool outsideCounts(const CostmapOptions& options) {
  return options.outside == Outside::OCCUPIED ||
         (options.outside == Outside::UNKNOWN && unknownCounts(options));
}

}  // namespace

FootprintCheck::FootprintCheck(const Footprint& footprint, const CostGrid& costs,
                               const PlannerOptions& options)
    : footprint_(footprint),
      costs_(costs),
      heading_(options.heading),
      counted_{unknownCounts(options.costmap), outsideCounts(options.costmap)},
      sweep_(sweepOver(true, counted_)) {}

FootprintSweep FootprintCheck::sweepOver(bool occupied, Counted counted) const {
  FootprintObstacles obstacles;
  obstacles.outside = counted.outside;
  obstacles.first = [&classes = costs_.classes(), occupied,
                     unknown = counted.unknown](const RowSpan& span) {
    const Occupancy* row = classes.row(span.row);
    int column = span.first;
    while (column < span.end && !(occupied && row[column] == Occupancy::OCCUPIED) &&
           !(unknown && row[column] == Occupancy::UNKNOWN))
      ++column;
    return column;
  };
  return {footprint_, costs_.geometry(), obstacles};
}

void FootprintCheck::allowFor(const std::vector<Pose>& ends) {
  const auto meets = [&](bool counts, Counted only) {
    if (!counts) return false;
    const FootprintSweep sweep = sweepOver(false, only);
    for (const Pose& end : ends)
      if (sweep.standing(end.position.head<2>(), end.yaw)) return true;
    return false;
  };
  allowed_.unknown = meets(counted_.unknown, {true, false});
  allowed_.outside = meets(counted_.outside, {false, true});
  sweep_ = sweepOver(
      true, {counted_.unknown && !allowed_.unknown, counted_.outside && !allowed_.outside});
}

std::string FootprintCheck::note() const {
  const char* both = allowed_.unknown && allowed_.outside
                         ? "unknown cells and the outside of the map"
                     : allowed_.unknown ? "unknown cells"
                     : allowed_.outside ? "the outside of the map"
                                        : "";
  return *both == '\0' ? ""
                       : std::string("the footprint may reach into ") + both + ", as at its ends";
}

std::string FootprintCheck::complaint(const Pose& pose) const {
  const auto cell = sweep_.standing(pose.position.head<2>(), pose.yaw);
  if (!cell) return "";
  return "with " + headingText(pose.yaw) + ": the footprint meets " + cellText(*cell);
}

std::optional<FootprintContact> FootprintCheck::first(const Path& path,
                                                      std::optional<double> start_yaw,
                                                      std::optional<double> goal_yaw,
                                                      const StopToken& stop) const {
  for (const Motion& motion : motionsAlong(path, start_yaw, goal_yaw, heading_))
    if (const auto contact = sweep_.first(motion, stop)) return contact;
  return std::nullopt;
}

std::vector<FootprintContact> FootprintCheck::contacts(const Path& path,
                                                       std::optional<double> start_yaw,
                                                       std::optional<double> goal_yaw,
                                                       const StopToken& stop) const {
  std::vector<FootprintContact> all;
  for (const Motion& motion : motionsAlong(path, start_yaw, goal_yaw, heading_))
    for (const FootprintContact& contact : sweep_.all(motion, stop)) all.push_back(contact);
  return all;
}

std::string FootprintCheck::cellText(Cell cell) const {
  const std::string at = positionText(costs_.geometry().centre(cell));
  if (!costs_.geometry().contains(cell)) return "the outside of the map at " + at;
  return (costs_.occupancy(cell) == Occupancy::UNKNOWN ? "the unknown cell at "
                                                       : "the occupied cell at ") +
         at;
}

std::string FootprintCheck::text(const FootprintContact& contact) const {
  return "the footprint meets " + cellText(contact.cell) + " with the vehicle at " +
         positionText(contact.position) + ", " + headingText(contact.yaw) +
         (contact.on_the_spot ? ", turning on the spot" : "");
}

}  // namespace grid_path_planner::planning
