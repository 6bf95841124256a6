#include "fuzz/fuzz_target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<FuzzTarget>& registered() {
  static std::vector<FuzzTarget> targets;
  return targets;
}

}  // namespace

const std::vector<FuzzTarget>& fuzzTargets() {
  return registered();
}

FuzzRegistration::FuzzRegistration(const FuzzTarget& target) {
  std::vector<FuzzTarget>& targets = registered();
  const auto after = [](const FuzzTarget& a, const FuzzTarget& b) { return a.name < b.name; };
  targets.insert(std::upper_bound(targets.begin(), targets.end(), target, after), target);
}

void mustHold(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

std::string fileOf(const std::string& name, const std::string& content) {
  static const test::TemporaryFolder folder;
  return folder.write(name, content);
}

}  // namespace grid_path_planner::fuzz
