// The flights of a study in order, by number: variant by variant, world by world, seed by seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flights/flight_study.h"

namespace grid_path_planner::flights {

struct FlightUnit {
  std::size_t variant = 0;
  std::size_t world = 0;
  int seed = 0;
};

class FlightPlan {
 public:
  explicit FlightPlan(FlightStudy study);

  const FlightStudy& study() const { return study_; }
  const std::vector<FlightUnit>& units() const { return units_; }

  // "LHLM/7/safe", with several worlds "LHLM/7/safe/course_203".
  std::string nameOf(const FlightUnit& unit) const;
  // The first unit whose name begins with the parts of `name` ("LHLM/7"). Throws InputError where there is
  // none.
  FlightUnit unitOf(const std::string& name) const;

  // A hash of the study (options, worlds as they are read, programs, seeds) and of the sources that fly it. Throws
  // InputError for a world or a program that cannot be read.
  std::uint64_t fingerprint() const;

 private:
  FlightStudy study_;
  std::vector<FlightUnit> units_;
};

}  // namespace grid_path_planner::flights
