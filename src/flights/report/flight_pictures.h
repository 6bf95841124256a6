// Flights from above, as SVG.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "flights/report/flight_data.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::flights {

// What of a world lies between two heights, from above: a polygon (its convex hull) for each mesh.
using Outline = std::vector<Eigen::Vector2d>;
std::vector<Outline> outlinesOf(const simulation::World& world, double low, double high);

// All of these flights on a world: those that came home in blue, others in red with a cross at their
// end; waypoints are rings as large as the radius of arrival.
std::string flightsPicture(const FlightStudy& study, const std::vector<Outline>& outlines,
                           const std::vector<const FlightRecord*>& flights,
                           const std::string& title);

// The end of one flight, 8 m around it.
std::string endPicture(const FlightStudy& study, const std::vector<Outline>& outlines,
                       const FlightRecord& flight, const std::string& title);

// The SVG as a file of its own.
std::string standalonePicture(const std::string& svg);

}  // namespace grid_path_planner::flights
