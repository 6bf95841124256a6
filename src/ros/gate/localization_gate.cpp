#include "ros/gate/localization_gate.h"

#include "base/seconds_since.h"
#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {

using base::decimalText;

bool LocalizationGate::hear(const std::string& text, double now) {
  const std::string word = text.substr(0, text.find(':'));
  if (word == "OK")
    status_ = Status::OK;
  else if (word == "DEGRADED")
    status_ = Status::DEGRADED;
  else if (word == "LOST" || word == "INITIALIZING")
    status_ = Status::LOST;
  else
    return false;
  if (status_ != Status::DEGRADED) degraded_since_.reset();
  if (status_ == Status::DEGRADED && !degraded_since_) degraded_since_ = now;
  text_ = text;
  last_heard_ = std::chrono::steady_clock::now();
  return true;
}

bool LocalizationGate::grant(double now, const DegradedDriving& degraded) {
  if (!degraded_since_ || now - *degraded_since_ < degraded.time) return false;
  degraded_since_ = now;
  return true;
}

std::optional<std::string> LocalizationGate::problem(double now,
                                                     const DegradedDriving& degraded) const {
  if (!status_) return std::nullopt;
  if (base::secondsSince(last_heard_) > kSilent)
    return "the localiser has said nothing for more than " + decimalText(kSilent) + " s";
  if (status_ == Status::LOST) return "the localiser says " + text_;
  if (!degraded_since_ || now - *degraded_since_ < degraded.time) return std::nullopt;
  return "the localiser has said DEGRADED for degraded_time, " + decimalText(degraded.time) +
         " s (~resume drives on for as long): " + text_;
}

double LocalizationGate::speedShare(const DegradedDriving& degraded) const {
  return status_ == Status::DEGRADED ? degraded.speed : 1.0;
}

}  // namespace grid_path_planner::nodes
