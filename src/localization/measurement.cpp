#include "localization/measurement.h"

namespace grid_path_planner::localization {

const char* nameOf(Source source) {
  static constexpr std::array<const char*, kSources> kNames = {
      "set pose", "IMU", "DVL", "cmd_vel", "depth", "heading", "USBL", "marker pose"};
  return kNames[static_cast<std::size_t>(source)];
}

const char* nameOf(Verdict verdict) {
  static constexpr std::array<const char*, 6> kNames = {"taken",  "gated",     "reset",
                                                        "unused", "duplicate", "too old"};
  return kNames[static_cast<std::size_t>(verdict)];
}

}  // namespace grid_path_planner::localization
