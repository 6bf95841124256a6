#include "ros/localization/kept_heading.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr char kRunOfHeading[] = "7-a";

std::vector<std::string> seedsOfKeptHeadings() {
  return {nodes::lineOf({1'700'000'000'123'456'789, -0.25, 3e-4}, kRunOfHeading),
          nodes::lineOf({1'700'000'000'123'456'789, -0.25, 3e-4}, "8-b")};
}

FUZZ_TARGET(kept_heading, seedsOfKeptHeadings) {
  const auto kept = nodes::headingIn(input, kRunOfHeading);
  if (!kept) return;
  const auto again = nodes::headingIn(nodes::lineOf(*kept, kRunOfHeading), kRunOfHeading);
  mustHold(again && again->stamp == kept->stamp && again->offset == kept->offset &&
               again->variance == kept->variance,
           "what is kept is read back");
}

}  // namespace
}  // namespace grid_path_planner::fuzz
