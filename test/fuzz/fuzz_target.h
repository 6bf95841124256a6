// What libFuzzer is set on: a reader of files or a function that judges messages, with the seeds that
// its corpus begins with.
//
//   FUZZ_TARGET(moving_ai_map, seedsOfMaps) {
//     mayRefuse([&] { parseMovingAi(input, "fuzz.map", {}); });
//   }
//
// Each may be given any bytes at all, and answers with a result or an InputError: any other exception,
// what the sanitizers find, and what takes too long or too much memory ends the program. scripts/fuzz
// runs them; the unit tests run each over its seeds and damaged copies of these.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::fuzz {

struct FuzzTarget {
  std::string name;
  std::vector<std::string> (*seeds)();
  void (*run)(const std::string& input);
};

// All of the program, by name.
const std::vector<FuzzTarget>& fuzzTargets();

struct FuzzRegistration {
  explicit FuzzRegistration(const FuzzTarget& target);
};

#define FUZZ_TARGET(name, seeds)                                                  \
  static void name##Target(const std::string& input);                             \
  static const FuzzRegistration name##Registration({#name, seeds, name##Target}); \
  static void name##Target(const std::string& input)

// Lets an InputError pass, which is an answer.
template <class Calls>
void mayRefuse(const Calls& calls) {
  try {
    calls();
  } catch (const base::InputError&) {
  }
}

// Of readers whose inputs may ask for much: 64 MB, 5 s from now on.
inline base::ReadLimits smallLimits() {
  base::ReadLimits limits({64, 5.0});
  limits.start();
  return limits;
}

// Ends the program where it does not hold, in every build.
void mustHold(bool condition, const char* what);

// Writes `content` to the file `name` in a folder in memory and gives its path, for readers of files.
std::string fileOf(const std::string& name, const std::string& content);

}  // namespace grid_path_planner::fuzz
