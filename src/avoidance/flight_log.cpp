#include "grid_path_planner/avoidance/flight_log.h"
namespace grid_path_planner::avoidance {
FlightLog::FlightLog(const std::string& file, const PilotOptions&, std::uint64_t limit):out_(file),left_(limit){}
void FlightLog::route(const std::vector<Eigen::Vector3d>&){}
void FlightLog::mapPlan(const std::vector<Eigen::Vector3d>&){}
void FlightLog::update(const PilotInput&, const PilotAnswer&){}
ReplayResult replayFlight(const std::string&, const std::function<void(const PilotInput&, const PilotAnswer&)>&){return {};}
}
