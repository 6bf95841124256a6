#include "command_line/node_config.h"

#include <iostream>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfNodeConfigs() {
  return {
      "radius: 0.5\nplanner: anya\nsmooth: true\nfootprint: [[0.5, 0.3], [0.5, -0.3], [-1, 0]]\n",
      "/path_planner: {radius: 1}\nmap_frame: odom\ntimeout: 1e1\n", "~\n"};
}

// Takes what is printed until its end.
class SilentWarnings {
 public:
  SilentWarnings() : before_(std::cerr.rdbuf(nullptr)) {}
  ~SilentWarnings() { std::cerr.rdbuf(before_); }
  SilentWarnings(const SilentWarnings&) = delete;
  SilentWarnings& operator=(const SilentWarnings&) = delete;

 private:
  std::streambuf* before_;
};

FUZZ_TARGET(node_config, seedsOfNodeConfigs) {
  const SilentWarnings silent;
  const std::string file = fileOf("fuzz_node.yaml", input);
  planning::PlannerOptions options;
  try {
    command_line::readNodeConfig(file, options);
    base::checkOptionLimits(options);
  } catch (const base::InputError&) {
    static const std::string before = base::optionText(planning::PlannerOptions());
    mustHold(base::optionText(options) == before, "a file that is refused changes nothing");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
