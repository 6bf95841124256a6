#include "ros/guard/network_text.h"

#include <algorithm>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfTexts() {
  return {"map", "/map", "$(rm -rf x)", "a`b", "\xc3\xa4", "\xf0\x9f\x98\x80", "a\nb", "\xc2\x9b"};
}

FUZZ_TARGET(network_text, seedsOfTexts) {
  const std::string text = nodes::printable(input);
  mustHold(text.empty() || text == input, "text is taken as it is, or not at all");
  mustHold(text.find_first_of("\"'$`\\\n\r\t\x1b\x7f") == std::string::npos, "text is harmless");
  mayRefuse([&] { nodes::frameName(input); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
