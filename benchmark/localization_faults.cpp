// What vehicle_localizer says with sensors that are mounted, wired or configured wrongly.
//
//   grid_path_planner_localization_faults [SECONDS [SEEDS [FAULT]]]
//
// For each fault, without and with marker poses: how long the pose was off by 1 m or 12 degrees (mean, s), when a second
// fix, view or depth contradicted it then, when LOST was said first (earliest and latest of the seeds, s), for how long
// OK or DEGRADED was said while it was off after that (worst, s), and the shares of what was said. Of one FAULT by its
// name: each second. At last sound sensors, whose acoustic fixes have no outliers, 5 % and 20 %.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "localization/support/systematic_faults.h"

namespace {

using namespace grid_path_planner::localization;

struct Row {
  double off = 0.0, longest = 0.0;
  double second_first = INFINITY, second_last = -INFINITY;
  double lost_first = INFINITY, lost_last = -INFINITY;
  std::array<double, 4> shares{};

  void add(const VerdictRun& run, unsigned seeds) {
    off += run.off / seeds;
    longest = std::max(longest, run.longest);
    second_first = std::fmin(second_first, run.second);
    second_last = std::fmax(second_last, run.second);
    lost_first = std::fmin(lost_first, run.lost);
    lost_last = std::fmax(lost_last, run.lost);
    for (const VerdictSecond& second : run.seconds)
      shares[static_cast<std::size_t>(second.report.status)] +=
          1.0 / (static_cast<double>(run.seconds.size()) * seeds);
  }
};

void print(const char* name, const Row& row) {
  std::printf(
      "%-34s off %5.1f  second %5.1f..%5.1f  lost %5.1f..%5.1f  wrong %4.1f  "
      "initializing %.2f ok %.2f degraded %.2f lost %.2f\n",
      name, row.off, row.second_first, row.second_last, row.lost_first, row.lost_last, row.longest,
      row.shares[0], row.shares[1], row.shares[2], row.shares[3]);
}

void printSeconds(const VerdictRun& run) {
  for (const VerdictSecond& second : run.seconds)
    std::printf("%6.1f s  %8.2f m %6.1f deg  %s: %s\n", second.t, second.metres, second.degrees,
                nameOf(second.report.status), second.report.sentence.c_str());
}

void printFaults(Suite suite, double seconds, unsigned seeds, const std::string& only) {
  std::printf("%s\n", suite == Suite::USBL ? "acoustic fixes" : "acoustic fixes and markers");
  for (const SystematicFault& fault : systematicFaults()) {
    if (!only.empty() && only != fault.name) continue;
    Row row;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const VerdictRun run = runWithFault(fault, sensorsOf(suite, seed), seconds);
      row.add(run, seeds);
      if (!only.empty()) printSeconds(run);
    }
    print(fault.name, row);
  }
}

void printSound(Suite suite, double seconds, unsigned seeds) {
  const SystematicFault none{"none", [](Measurement&, double, SimulatedSensors&) {}};
  for (const double outliers : {0.0, 0.05, 0.2}) {
    Row row;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      SimulatedSensors sensors = sensorsOf(suite, seed);
      sensors.usbl_outliers = outliers;
      row.add(runWithFault(none, sensors, seconds), seeds);
    }
    print(("sound, outliers " + std::to_string(outliers)).c_str(), row);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 100.0;
  const unsigned seeds = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 3;
  const std::string only = argc > 3 ? argv[3] : "";
  for (const Suite suite : {Suite::USBL, Suite::MARKERS}) {
    printFaults(suite, seconds, seeds, only);
    if (only.empty()) printSound(suite, seconds, seeds);
  }
  return 0;
}
