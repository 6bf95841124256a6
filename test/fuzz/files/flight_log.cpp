#include "grid_path_planner/avoidance/flight_log.h"

#include "fuzz/fuzz_target.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

using avoidance::FlightLog;
using avoidance::Frame;
using avoidance::Pilot;
using avoidance::PilotInput;
using avoidance::VehiclePose;

Frame smallFrame(double time) {
  Frame frame;
  frame.time = time;
  frame.map_from_sensor.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  frame.width = 4;
  frame.height = 3;
  frame.pinhole = avoidance::Pinhole{3.0, 3.0, 1.5, 1.0};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      for (const double value : {4.0 * (column - 1.5) / 3.0, 4.0 * (row - 1.0) / 3.0, 4.0})
        frame.points.push_back(static_cast<float>(value));
  return frame;
}

// Of a flight of a second with everything that a log may hold.
std::vector<std::string> seedsOfLogs() {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("seed.flight");
  {
    Pilot pilot;
    FlightLog log(file, pilot.options(), 1 << 20);
    pilot.setRoute({{3.0, 0.0, 0.0}});
    log.route({{3.0, 0.0, 0.0}});
    log.path({{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
    log.options(pilot.options());
    log.mapPlan({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
    for (int i = 0; i < 4; ++i) {
      const Frame frame = smallFrame(0.1 * i);
      log.see(frame);
      PilotInput input;
      input.time = 0.1 * i;
      input.pose = VehiclePose{};
      input.frame = &frame;
      log.update(input, pilot.update(input));
    }
    log.cancel("enough");
    log.forget();
  }
  return {test::contentOf(file)};
}

FUZZ_TARGET(flight_log, seedsOfLogs) {
  const std::string file = fileOf("fuzz.flight", input);
  mayRefuse([&] {
    const avoidance::ReplayResult result = avoidance::replayFlight(file);
    mustHold(result.differing <= result.updates, "updates are counted");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
