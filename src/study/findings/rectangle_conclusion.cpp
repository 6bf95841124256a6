#include <algorithm>
#include <cmath>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/decomposition.h"
#include "study/findings/finding_text.h"
#include "study/findings/published_cases.h"
#include "study/findings/verdicts.h"

namespace grid_path_planner::study {
namespace {

constexpr double kBytesOfRectangle = 8.0;  // the published measure

// What one query on a new map takes in all, ms.
double wholeProcess(const StudyRun& run) {
  return run.preparation_ms + medianTime(run);
}

// One ratio for each query on settings of one kernel.
std::vector<double> ratiosAt(const StudyData& data, int kernel, std::size_t dijkstra,
                             std::size_t rectangles) {
  std::vector<double> ratios;
  for (const ProblemSize& size : data.sizes()) {
    if (size.kernel != kernel) continue;
    const auto more = data.ratios(dijkstra, rectangles, &size, wholeProcess);
    ratios.insert(ratios.end(), more.begin(), more.end());
  }
  return ratios;
}

std::pair<int, int> kernelRange(const StudyData& data) {
  int least = data.sizes().front().kernel, most = least;
  for (const ProblemSize& size : data.sizes()) {
    least = std::min(least, size.kernel);
    most = std::max(most, size.kernel);
  }
  return {least, most};
}

// At full resolution.
std::size_t rectanglesOf(const std::shared_ptr<const grid::OccupancyGrid>& map,
                         const Study& study) {
  costmap::CostmapOptions options = study.settings.front().costmap;
  options.kernel = 1;
  costmap::CostmapBuilder builder(options);
  builder.setMap(map);
  const auto costs = builder.downsampled(base::StopToken());
  return planners::largestFirst(costs->bitMaps(base::StopToken()), {}, base::StopToken()).size();
}

// "indoor 4696 of 8192 bytes": at full resolution, as rectangles and with a bit a cell.
std::string bytesText(const StudyData& data) {
  std::string text;
  for (std::size_t i = 0; i < data.study().maps.size(); ++i) {
    const auto map = data.plan().map(i);
    const auto rectangles = static_cast<double>(rectanglesOf(map, data.study()));
    const double bits = static_cast<double>(map->geometry().size());
    text += (text.empty() ? "" : ", ") + data.study().maps[i].name + ' ' +
            shownNumber(kBytesOfRectangle * rectangles, 6) + " of " +
            shownNumber(std::ceil(bits / 8.0), 6);
  }
  return text;
}

}  // namespace

Conclusion rectangleConclusion(const StudyData& data) {
  Conclusion c;
  c.name = "C9";
  c.claim = "The rectangle map makes the whole process faster and smaller, the more the larger";
  c.interval = c.measure = "–";
  c.command = "grid_path study config/study_rectangles.yaml --out DIR, then DIR/preparation.csv";
  c.reason =
      "The rectangle map needs one weight, which this study's maps do not have. It has a study of "
      "its own, doc/study_rectangles.md.";
  const auto dijkstra = variantOf(data, "dijkstra"), rectangles = variantOf(data, "rectangle_map");
  if (!dijkstra || !rectangles || data.sizes().empty()) return c;
  const auto [fine, coarse] = kernelRange(data);
  const std::vector<double> ratios = ratiosAt(data, fine, *dijkstra, *rectangles);
  const std::vector<double> smaller = ratiosAt(data, coarse, *dijkstra, *rectangles);
  if (ratios.empty() || smaller.empty()) return c;
  std::vector<double> logarithms;
  for (const double ratio : ratios) logarithms.push_back(std::log(ratio));
  const Interval ratio = meanRatio(ratios);
  c.measure = "preparation and one plan, dijkstra / rectangle_map, kernel " + std::to_string(fine);
  c.interval = intervalText(ratio);
  c.p = pairedP(logarithms);
  c.needs_test = true;
  if (ratio.low > 1.0) c.verdict = Verdict::CONFIRMED;
  if (ratio.high < 1.0) c.verdict = Verdict::REFUTED;
  c.reason =
      std::string(
          c.verdict == Verdict::CONFIRMED
              ? "Cutting the map and one plan on it take less than one search on its cells"
              : "Cutting the map takes longer than the one search on cells that it saves, with a "
                "Dijkstra of buckets where the published one took 7.7 s") +
      " (at kernel " + std::to_string(coarse) + " the ratio is " +
      intervalText(meanRatio(smaller)) +
      "); the table of preparation says from how many plans on cutting pays. Bytes, 8 a rectangle "
      "as published "
      "against a bit a cell: " +
      bytesText(data) + ".";
  return c;
}

}  // namespace grid_path_planner::study
