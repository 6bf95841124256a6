#include "flights/flight_pilot.h"

#include <optional>

#include "flights/program_pilot.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "seen_map/seen_map.h"

namespace grid_path_planner::flights {

using avoidance::FlightLog, avoidance::Pilot, avoidance::PilotAnswer, avoidance::PilotInput;
using Eigen::Vector3d;

namespace {

constexpr std::uint64_t kLargestLog = std::uint64_t{4} << 30;  // bytes

class OwnPilot : public FlightPilot {
 public:
  OwnPilot(const FlightStudy& study, const FlightVariant& variant, const std::string& log)
      : pilot_(variant.pilot), map_(variant.pilot), log_name_(log) {
    if (!log.empty()) log_.emplace(log, variant.pilot, kLargestLog);
    pilot_.setRoute(study.route);
    if (log_) log_->route(study.route);
    if (!variant.pilot.recover) return;
    pilot_.setMapPlan([this](const Vector3d& from, const Vector3d& goal) {
      std::vector<Vector3d> plan = map_.plan(from, goal);
      if (log_) log_->mapPlan(plan);
      return std::optional(std::move(plan));
    });
  }

  PilotAnswer update(const PilotInput& input) override {
    if (input.frame != nullptr && pilot_.options().recover) map_.see(*input.frame);
    const PilotAnswer answer = pilot_.update(input);
    if (!log_) return answer;
    log_->update(input, answer);
    if (!log_->problem().empty())
      throw base::InputError(log_name_, "cannot be written: " + log_->problem());
    return answer;
  }

  std::string explain() const override { return pilot_.explain(); }

 private:
  Pilot pilot_;
  seen_map::SeenMap map_;
  std::string log_name_;
  std::optional<FlightLog> log_;
};

}  // namespace

std::unique_ptr<FlightPilot> makeFlightPilot(const FlightStudy& study, const FlightVariant& variant,
                                             const simulation::CameraIntrinsics& camera,
                                             const std::string& log) {
  if (!variant.program.empty()) return std::make_unique<ProgramPilot>(study, variant, camera);
  return std::make_unique<OwnPilot>(study, variant, log);
}

}  // namespace grid_path_planner::flights
