#include <map>
#include <sstream>

#include "study/findings/published_cases.h"
#include "study/report/markup.h"
#include "study/report/report_pictures.h"
#include "study/report/results_page.h"
#include "study/report/svg_chart.h"

namespace grid_path_planner::study {

using grid::GridGeometry;

namespace {

// An inline SVG as a file of its own: it needs its name space and the fonts of the page.
std::string standalone(const std::string& svg) {
  if (svg.empty()) return "";
  const std::string tag = "<svg ";
  const std::size_t body = svg.find('>') + 1;
  return tag +
         "xmlns=\"http://www.w3.org/2000/svg\" style=\"background:#fff;font:12px sans-serif\" " +
         svg.substr(tag.size(), body - tag.size()) +
         "<style>.grid{stroke:#dde3e8}.chart-title{font-weight:bold}</style>" + svg.substr(body) +
         '\n';
}

// One variant of each planner: the first.
std::vector<std::size_t> programsOf(const StudyData& data) {
  std::map<std::string, bool> seen;
  std::vector<std::size_t> programs;
  for (std::size_t i = 0; i < data.study().variants.size(); ++i)
    if (!std::exchange(seen[data.study().variants[i].planner], true)) programs.push_back(i);
  return programs;
}

struct DrawnPath {
  const StudyRun* filled = nullptr;
  const StudyRun* unfilled = nullptr;
  const StudySetting* setting = nullptr;
};

// Of the first published variant: the case with the most cells in unfilled blocks.
DrawnPath mostThroughBorder(const StudyData& data) {
  const PublishedFigures& published = data.study().published;
  DrawnPath best;
  const auto variant = variantOf(data, published.planner);
  if (!variant || published.group.empty()) return best;
  const auto filled = publishedCases(data, published.group, Border::FILLED);
  for (const PublishedCase& on : publishedCases(data, published.group, Border::UNFILLED)) {
    const StudyRun* run = on.found(*variant);
    if (run == nullptr || run->path_xy.empty()) continue;
    if (best.unfilled != nullptr && run->border_cells <= best.unfilled->border_cells) continue;
    const PublishedCase* off = sameCase(filled, on);
    const StudyRun* other = off == nullptr ? nullptr : off->found(*variant);
    if (other != nullptr && !other->path_xy.empty()) best = {other, run, on.setting};
  }
  return best;
}

std::string polyline(const StudyRun& run, const GridGeometry& geometry, std::size_t series) {
  std::ostringstream points;
  for (const Eigen::Vector2d& at : cornersInPicture(run, geometry))
    points << at.x() << ',' << at.y() << ' ';
  return "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" + seriesColour(series) +
         "\" stroke-dasharray=\"" + seriesDash(series) + "\" points=\"" + points.str() + "\"/>";
}

std::string legendLine(std::size_t series, double y, const std::string& words) {
  std::ostringstream line;
  line << "<path d=\"M4 " << y - 3 << "h24\" stroke-width=\"2\" stroke=\"" << seriesColour(series)
       << "\" stroke-dasharray=\"" << seriesDash(series) << "\"/><text x=\"32\" y=\"" << y
       << "\" font-size=\"9\">" << escaped(words) << "</text>";
  return line.str();
}

std::string wordsFor(const char* border, const StudyRun& run) {
  return std::string(border) + ": " + std::to_string(run.cells) + " cells, " +
         std::to_string(run.border_cells) + " of them in the blocks that stayed unfilled";
}

}  // namespace

std::string timesPicture(const StudyData& data) {
  const std::size_t last = data.study().maps.size() - 1;
  std::vector<LineSeries> series;
  for (const std::size_t variant : programsOf(data)) {
    LineSeries line{data.study().variants[variant].label, {}};
    for (const ProblemSize& size : data.sizes()) {
      const std::vector<double> times = mediansOf(data, size, variant);
      if (size.map == last && size.border == Border::FILLED && !times.empty())
        line.points.emplace_back(blocksOf(data, size), quantileOf(times, 0.5));
    }
    series.push_back(line);
  }
  return standalone(linePlot("Planning time, " + data.study().maps[last].name +
                                 ": compare along a line, not programs of different kinds",
                             "cells (blocks) of the map", "ms, median", series));
}

std::string pathsPicture(const StudyData& data) {
  const DrawnPath drawn = mostThroughBorder(data);
  if (drawn.unfilled == nullptr || drawn.unfilled->border_cells == 0) return "";
  const GridGeometry& geometry = data.plan().map(drawn.setting->map)->geometry();
  std::ostringstream svg;
  svg << "<svg viewBox=\"0 0 " << geometry.width() << ' ' << geometry.height() + 30 << "\" width=\""
      << 2 * geometry.width() << "\"><image width=\"" << geometry.width() << "\" height=\""
      << geometry.height() << "\" href=\""
      << mapImage(*data.plan().map(drawn.setting->map), drawn.setting->costmap.thresholds) << "\"/>"
      << polyline(*drawn.filled, geometry, 0) << polyline(*drawn.unfilled, geometry, 1)
      << legendLine(0, geometry.height() + 12.0, wordsFor("filled", *drawn.filled))
      << legendLine(1, geometry.height() + 24.0, wordsFor("unfilled", *drawn.unfilled)) << "</svg>";
  return standalone(svg.str());
}

}  // namespace grid_path_planner::study
