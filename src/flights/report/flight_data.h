// The flights of a study by variant, and what the findings ask of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flights/flight_plan.h"
#include "flights/flight_record.h"

namespace grid_path_planner::flights {

class FlightData {
 public:
  // `plan` outlives the data. Records in the order of the plan.
  FlightData(const FlightPlan& plan, std::vector<FlightRecord> records);

  const FlightPlan& plan() const { return plan_; }
  const FlightStudy& study() const { return plan_.study(); }
  const std::vector<FlightRecord>& records() const { return records_; }
  const std::vector<const FlightRecord*>& of(std::size_t variant) const {
    return by_variant_[variant];
  }
  std::string nameOf(const FlightRecord& record) const;
  // `command`, which flew all, for this flight alone.
  std::string commandOf(const FlightRecord& record, const std::string& command) const;

  std::size_t successes(std::size_t variant) const;
  std::size_t count(std::size_t variant, FlightEnd end) const;
  // Of the flights that came home.
  std::vector<double> values(std::size_t variant,
                             const std::function<double(const FlightRecord&)>& value) const;
  std::optional<std::size_t> variantOf(const std::string& name, const std::string& rules) const;
  std::vector<std::string> rules() const;  // that were flown, in their order

 private:
  const FlightPlan& plan_;
  std::vector<FlightRecord> records_;
  std::vector<std::vector<const FlightRecord*>> by_variant_;
};

inline double timeOf(const FlightRecord& record) {
  return record.time_s;
}
inline double lengthOf(const FlightRecord& record) {
  return record.length_m;
}

}  // namespace grid_path_planner::flights
