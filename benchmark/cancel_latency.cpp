// How long a cancelled planning goes on, over its whole course on a map of 4000x4000 cells.
//
//   grid_path_planner_cancel_latency [KERNEL [SAMPLES]]
//
// Plans once without interruption, then cancels fresh plannings at moments spread evenly over that
// time: in the inflation, the kernel, the planner's preparation and the search alike. Prints the
// latencies.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"

namespace {

using namespace grid_path_planner::base;
using namespace grid_path_planner::grid;
using namespace grid_path_planner::planning;
using Clock = std::chrono::steady_clock;

std::shared_ptr<const OccupancyGrid> noisyMap() {
  auto map = std::make_shared<OccupancyGrid>(GridGeometry(4000, 4000, 0.05));
  std::mt19937 random(1);
  for (auto& value : map->values()) value = random() % 50 == 0 ? 100 : 0;
  return map;
}

PlannerOptions optionsWith(int kernel) {
  PlannerOptions options;
  options.planner = "dijkstra";
  options.timeout = 0.0;
  options.costmap.radius = 0.05;
  options.costmap.decay = 5.0;
  options.costmap.kernel = kernel;
  options.costmap.outside = grid_path_planner::costmap::Outside::FREE;
  options.smooth = false;  // what is cancelled is the search
  options.start_escape_radius = options.tolerance = 5.0;
  return options;
}

double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

PoseRequest acrossTheMap() {
  PoseRequest request;
  request.start.position << 5.0, 5.0, 0.0;
  request.goal.position << 195.0, 195.0, 0.0;
  return request;
}

// Plans and is cancelled after `delay`; the time from the cancelling to the answer, or a negative
// one where the answer came first.
double latency(PathPlanner& planner, double delay) {
  StopSource stop;
  Clock::time_point answered;
  std::thread planning([&] {
    planner.plan(acrossTheMap(), stop);
    answered = Clock::now();
  });
  std::this_thread::sleep_for(std::chrono::duration<double>(delay));
  const Clock::time_point cancelled = Clock::now();
  stop.cancel();
  planning.join();
  return seconds(answered - cancelled);
}

}  // namespace

int main(int argc, char** argv) {
  const int kernel = argc > 1 ? std::atoi(argv[1]) : 1;
  const int samples = argc > 2 ? std::atoi(argv[2]) : 20;
  const auto map = noisyMap();
  const auto freshPlanner = [&] {
    auto planner = std::make_unique<PathPlanner>(optionsWith(kernel));
    planner->setMap(map);
    return planner;
  };
  const auto whole = freshPlanner();
  const Clock::time_point begin = Clock::now();
  const Plan report = whole->plan(acrossTheMap());
  const double total = seconds(Clock::now() - begin);
  std::printf("kernel %d, smooth false: %s after %.2f s (preparation %.2f s, search %.2f s)\n",
              kernel, std::string(toString(report.status)).c_str(), total,
              report.preparation_time_s, report.statistics.time_s);
  std::vector<double> latencies;
  for (int i = 0; i < samples; ++i) {
    const auto planner = freshPlanner();
    const double delay = total * (i + 0.5) / samples;
    const double waited = latency(*planner, delay);
    if (waited >= 0.0) latencies.push_back(waited);
    std::printf("  cancelled at %.3f s: answered after %.1f ms\n", delay, waited * 1e3);
  }
  std::sort(latencies.begin(), latencies.end());
  if (!latencies.empty())
    std::printf("largest %.1f ms, median %.1f ms\n", latencies.back() * 1e3,
                latencies[latencies.size() / 2] * 1e3);
  return 0;
}
