// What a frame costs the pilot: memory, search and steering together.
//
//   grid_path_planner_avoidance_frame [WORLD.sdf [SECONDS [X,Y,Z]]]
//
// Flies to X,Y,Z (30,10,1.5) by each search, with a camera of 320x240 at 10 Hz, and prints the processor
// time of the updates with a frame: mean, 99th percentile, longest; beside it what rendering took.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "avoidance/simulated_flight.h"

namespace {

using namespace grid_path_planner;
using namespace grid_path_planner::avoidance;

double cpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void measure(const FlightSetup& setup, const char* name) {
  SimulatedFlight flight(setup);
  std::vector<double>& times = flight.frameMilliseconds(&cpuMilliseconds);
  const FlightResult result = flight.run();
  std::sort(times.begin(), times.end());
  double sum = 0.0;
  for (const double time : times) sum += time;
  const std::size_t last = times.size() - 1;
  std::printf("%-10s %6zu frames  mean %6.2f  p99 %6.2f  longest %6.2f ms  %s\n", name,
              times.size(), sum / static_cast<double>(times.size()), times[last * 99 / 100],
              times[last], toString(result.status));
}

}  // namespace

int main(int argc, char** argv) {
  FlightSetup setup;
  setup.world = std::make_shared<const simulation::World>(
      simulation::readWorld(argc > 1 ? argv[1] : "worlds/rescue_course.sdf"));
  setup.seconds = argc > 2 ? std::atof(argv[2]) : 60.0;
  Eigen::Vector3d goal(30.0, 10.0, 1.5);
  if (argc > 3 && std::sscanf(argv[3], "%lf,%lf,%lf", &goal.x(), &goal.y(), &goal.z()) != 3)
    return 2;
  setup.options = flyingOptions();
  setup.waypoints = {goal};
  setup.width = 320;
  setup.height = 240;
  for (const auto& [search, name] :
       {std::pair{Search::GRID, "grid"}, std::pair{Search::TREE, "tree"},
        std::pair{Search::DIRECTION, "direction"}}) {
    setup.options.search = search;
    measure(setup, name);
  }
  return 0;
}
