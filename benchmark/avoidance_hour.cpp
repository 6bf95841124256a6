// Whether the pilot's memory stays flat: what the process holds while it flies the tour of the study again and
// again, by the default configuration, with a camera of 320x240 at 10 Hz.
//
//   grid_path_planner_avoidance_hour [WORLD.sdf [SECONDS [EVERY]]]
//
// Prints the resident memory (MB) before the flight and each EVERY (300) of SECONDS (3600), both simulated, with
// how many rounds were flown. World, camera and vehicle are in it, and do not grow.
#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "avoidance/simulated_flight.h"

namespace {

using namespace grid_path_planner;
using namespace grid_path_planner::avoidance;

double residentMegabytes() {
  long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*s %ld", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

// With one that has nothing to do yet; it makes its memory when it is made.
double megabytesOfPilot(const FlightSetup& setup) {
  const Pilot pilot(setup.options);
  return residentMegabytes();
}

constexpr int kPlaces = 5;  // of a round

std::vector<Eigen::Vector3d> rounds(int count) {
  const Eigen::Vector3d tour[kPlaces] = {
      {30, 10, 1.5}, {40, 7, 1.5}, {47, 4.5, 1.5}, {38.7, -7.5, 1.5}, {0, 0, 1.5}};
  std::vector<Eigen::Vector3d> route;
  for (int i = 0; i < count; ++i) route.insert(route.end(), std::begin(tour), std::end(tour));
  return route;
}

}  // namespace

int main(int argc, char** argv) {
  FlightSetup setup;
  setup.world = std::make_shared<const simulation::World>(
      simulation::readWorld(argc > 1 ? argv[1] : "worlds/rescue_course.sdf"));
  setup.seconds = argc > 2 ? std::atof(argv[2]) : 3600.0;
  const double every = argc > 3 ? std::atof(argv[3]) : 300.0;
  setup.options = flyingOptions();
  setup.waypoints = rounds(1 + static_cast<int>(setup.seconds / 40.0));
  setup.width = 320;
  setup.height = 240;
  setup.tracks = false;
  malloc_trim(0);
  const double before = residentMegabytes();
  std::printf("before    %7.1f MB, a pilot alone %.1f MB\n", before,
              megabytesOfPilot(setup) - before);
  double next = 0.0;
  setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&, const Pilot&) {
    if (input.time < next) return;
    next += every;
    std::printf("%6.0f s  %7.1f MB  %3d rounds  %s\n", input.time, residentMegabytes(),
                answer.waypoint / kPlaces, toString(answer.status));
    std::fflush(stdout);
  };
  const FlightResult result = fly(setup);
  std::printf("%6.0f s  %7.1f MB  %.0f m, %d contacts, least clearance %.2f m: %s\n",
              result.seconds, residentMegabytes(), result.metres, result.contacts,
              result.least_clearance, result.sentence.c_str());
  return 0;
}
