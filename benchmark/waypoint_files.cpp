// What reading a waypoint file takes, by the number of its waypoints.
//
//   grid_path_planner_waypoint_files [ROUNDS [MOST_WAYPOINTS]]
//
// Prints microseconds of CPU time a waypoint, medians and longest of the rounds: of a file as we write it, of the same text
// where the YAML parser has to read it, and of a bare reading beside them: the bytes, and each number by strtod().
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "support/temporary_folder.h"

namespace {

using grid_path_planner::base::readWholeFile, grid_path_planner::base::writeFileAtomically;
using grid_path_planner::path::Path, grid_path_planner::path::readWaypointFile;
using grid_path_planner::test::TemporaryFolder;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;  // bytes

Path randomPath(int waypoints) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> metres(-1000.0, 1000.0), yaw(-3.1, 3.1);
  Path path;
  path.frame_id = "map";
  for (int i = 0; i < waypoints; ++i)
    path.poses.push_back({{metres(random), metres(random), metres(random)}, yaw(random)});
  return path;
}

// The sum of the numbers of the file.
double bareReading(const std::string& file) {
  const std::string text = readWholeFile(file, kLargestFile);
  double sum = 0.0;
  for (const char* at = text.c_str(); *at != '\0';) {
    char* end = nullptr;
    const bool begins = std::isdigit(static_cast<unsigned char>(*at)) != 0 || *at == '-';
    if (begins) sum += std::strtod(at, &end);
    at = begins && end != at ? end : at + 1;
  }
  return sum;
}

struct Times {
  double median, longest;  // us a waypoint
};

Times timesOf(int rounds, int waypoints, const std::function<void()>& read) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i)
    times.push_back(1e3 * grid_path_planner::benchmark::milliseconds(read) / waypoints);
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.back()};
}

void measure(int rounds, int waypoints) {
  const TemporaryFolder folder;
  const std::string file = folder.path("plain.yaml"), parsed = folder.path("parsed.yaml");
  grid_path_planner::path::writeWaypointFile(file, randomPath(waypoints));
  writeFileAtomically(parsed, "# by the parser\n" + readWholeFile(file, kLargestFile));
  std::size_t read = 0;
  double sum = 0.0;
  const Times ours =
      timesOf(rounds, waypoints, [&] { read += readWaypointFile(file).path.poses.size(); });
  const Times yaml = timesOf(std::max(1, rounds / 10), waypoints,
                             [&] { read += readWaypointFile(parsed).path.poses.size(); });
  const Times bare = timesOf(rounds, waypoints, [&] { sum += bareReading(file); });
  if (read == 0 || !std::isfinite(sum)) std::abort();
  std::printf("%9d%9.2f%9.2f%9.1f%9.1f%9.2f%9.2f%9.1f\n", waypoints, ours.median, ours.longest,
              yaml.median, yaml.longest, bare.median, bare.longest, ours.median / bare.median);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 51;
  std::printf("us of CPU time a waypoint, median and longest of %d rounds\n", rounds);
  std::printf("%9s%18s%18s%18s%9s\n", "waypoints", "as written", "by the parser", "bare", "ratio");
  const int most = argc > 2 ? std::atoi(argv[2]) : 100000;
  for (const int waypoints : {1000, 5000, 20000, 100000})
    if (waypoints <= most) measure(rounds, waypoints);
}
