// Charts as inline SVG, readable without colours: series differ in shade, dash and mark too.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grid_path_planner::study {

struct BoxSeries {
  std::string name;
  std::vector<double> values;  // positive
};

struct BoxGroup {
  std::string label;
  std::vector<BoxSeries> series;  // the same names in the same order in every group
};

struct LineSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;  // x, y, both positive
};

// Okabe & Ito's colours, distinguishable with colour blindness, in a fixed order, repeated.
std::string seriesColour(std::size_t series);
// A stroke-dasharray; "" for a solid line.
std::string seriesDash(std::size_t series);

// Boxes from the lower to the upper quartile with the median, whiskers to the extremes; the axis is
// logarithmic.
std::string boxPlot(const std::string& title, const std::string& axis,
                    const std::vector<BoxGroup>& groups);

// Points joined by lines in the order of x; both axes are logarithmic.
std::string linePlot(const std::string& title, const std::string& x_axis, const std::string& y_axis,
                     const std::vector<LineSeries>& series);

}  // namespace grid_path_planner::study
