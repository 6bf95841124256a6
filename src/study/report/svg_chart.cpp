#include "study/report/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "study/confidence.h"
#include "study/report/markup.h"
#include "study/report/table.h"

namespace grid_path_planner::study {
namespace {

constexpr double kWidth = 760.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 12.0;
constexpr double kTop = 30.0;
constexpr double kPlotHeight = 300.0;
constexpr double kLegendLine = 20.0;
constexpr std::size_t kShortName = 26;  // letters that fit into a third of the legend

// Maps values to coordinates of a logarithmic axis.
class LogAxis {
 public:
  LogAxis(double least, double most, double from, double to) : from_(from), to_(to) {
    low_ = std::log10(least) - 0.05;
    high_ = std::log10(most) + 0.05;
    if (high_ - low_ < 0.3) {
      low_ -= 0.15;
      high_ += 0.15;
    }
  }
  double operator()(double value) const {
    return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
  }
  // 1, 2 and 5 of every decade, fewer where the axis is long, more where it is short.
  std::vector<double> ticks() const {
    std::vector<double> steps = {1.0, 2.0, 5.0};
    if (high_ - low_ > 3.0) steps = {1.0};
    if (high_ - low_ < 0.9) steps = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(low_)); decade <= high_; ++decade)
      for (const double step : steps) {
        const double value = step * std::pow(10.0, decade);
        if (std::log10(value) >= low_ && std::log10(value) <= high_) ticks.push_back(value);
      }
    return ticks;
  }

 private:
  double from_, to_, low_, high_;
};

std::string attribute(const char* name, double value) {
  std::ostringstream out;
  out.precision(6);
  out << ' ' << name << "=\"" << value << '"';
  return out.str();
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line" + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
         attribute("y2", y2) + ' ' + style + "/>";
}

std::string text(double x, double y, const std::string& anchor, const std::string& words,
                 const std::string& more = "") {
  return "<text" + attribute("x", x) + attribute("y", y) + " text-anchor=\"" + anchor + "\" " +
         more + '>' + escaped(words) + "</text>";
}

std::string strokeOf(std::size_t series) {
  std::string style = "stroke=\"" + seriesColour(series) + '"';
  const std::string dash = seriesDash(series);
  return dash.empty() ? style : style + " stroke-dasharray=\"" + dash + '"';
}

std::size_t legendColumns(const std::vector<std::string>& names) {
  const bool fits = std::all_of(names.begin(), names.end(),
                                [](const std::string& name) { return name.size() <= kShortName; });
  return fits ? 3 : 2;
}

std::string legend(const std::vector<std::string>& names, double top) {
  std::string svg;
  const std::size_t columns = legendColumns(names);
  const double column = (kWidth - kLeft) / static_cast<double>(columns);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double x = kLeft + column * static_cast<double>(i % columns);
    const double y = top + kLegendLine * static_cast<double>(i / columns);
    svg += line(x, y, x + 28.0, y, strokeOf(i) + " stroke-width=\"4\"");
    svg += text(x + 34.0, y + 4.0, "start", names[i]);
  }
  return svg;
}

double legendHeight(const std::vector<std::string>& names) {
  const std::size_t columns = legendColumns(names);
  return kLegendLine * static_cast<double>((names.size() + columns - 1) / columns);
}

std::string frame(const std::string& title, double height, const std::string& body) {
  std::ostringstream out;
  out << "<svg viewBox=\"0 0 " << kWidth << ' ' << height << "\" role=\"img\" aria-label=\""
      << escaped(title) << "\"><title>" << escaped(title) << "</title>"
      << text(kLeft, 16.0, "start", title, "class=\"chart-title\"") << body << "</svg>";
  return out.str();
}

std::string horizontalGrid(const LogAxis& axis, const std::string& name) {
  std::string svg;
  for (const double tick : axis.ticks()) {
    svg += line(kLeft, axis(tick), kWidth - kRight, axis(tick), "class=\"grid\"");
    svg += text(kLeft - 6.0, axis(tick) + 4.0, "end", shownNumber(tick));
  }
  const double middle = kTop + 0.5 * kPlotHeight;
  std::ostringstream turn;
  turn << "transform=\"rotate(-90 14 " << middle << ")\"";
  return svg + text(14.0, middle, "middle", name, turn.str());
}

std::string box(const BoxSeries& series, std::size_t number, double x, double width,
                const LogAxis& axis) {
  const double low = *std::min_element(series.values.begin(), series.values.end());
  const double high = *std::max_element(series.values.begin(), series.values.end());
  const double q1 = quantileOf(series.values, 0.25), q3 = quantileOf(series.values, 0.75);
  const double median = quantileOf(series.values, 0.5);
  const double middle = x + 0.5 * width;
  const std::string stroke = "stroke=\"" + seriesColour(number) + "\" stroke-width=\"1.5\"";
  std::string svg = "<g><title>" +
                    escaped(series.name + ": median " + shownNumber(median) + ", quartiles " +
                            shownNumber(q1) + " and " + shownNumber(q3) + ", extremes " +
                            shownNumber(low) + " and " + shownNumber(high)) +
                    "</title>";
  svg += line(middle, axis(low), middle, axis(high), stroke);
  svg += "<rect" + attribute("x", x) + attribute("y", axis(q3)) + attribute("width", width) +
         attribute("height", std::max(1.0, axis(q1) - axis(q3))) + " fill=\"" +
         seriesColour(number) + "\" fill-opacity=\"0.45\" " + strokeOf(number) + "/>";
  svg += line(x, axis(median), x + width, axis(median), "class=\"median\"");
  return svg + "</g>";
}

}  // namespace

std::string seriesColour(std::size_t series) {
  static const std::array<const char*, 8> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                     "#56B4E9", "#E69F00", "#000000", "#8A7A00"};
  return colours[series % colours.size()];
}

std::string seriesDash(std::size_t series) {
  static const std::array<const char*, 4> dashes = {"", "7 3", "2 3", "9 3 2 3"};
  return dashes[(series + series / 8) % dashes.size()];  // another dash where the colours repeat
}

std::string boxPlot(const std::string& title, const std::string& axis_name,
                    const std::vector<BoxGroup>& groups) {
  std::vector<double> all;
  std::vector<std::string> names;
  for (const BoxGroup& group : groups)
    for (const BoxSeries& series : group.series) {
      all.insert(all.end(), series.values.begin(), series.values.end());
      if (&group == &groups.front()) names.push_back(series.name);
    }
  if (all.empty()) return "";
  const LogAxis axis(*std::min_element(all.begin(), all.end()),
                     *std::max_element(all.begin(), all.end()), kTop + kPlotHeight, kTop);
  std::string body = horizontalGrid(axis, axis_name);
  const double group_width = (kWidth - kLeft - kRight) / static_cast<double>(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double left = kLeft + group_width * static_cast<double>(g);
    const double slot = group_width * 0.86 / static_cast<double>(names.size());
    for (std::size_t s = 0; s < groups[g].series.size(); ++s)
      if (!groups[g].series[s].values.empty())
        body += box(groups[g].series[s], s,
                    left + 0.07 * group_width + slot * (static_cast<double>(s) + 0.15),
                    std::min(46.0, 0.7 * slot), axis);
    body += text(left + 0.5 * group_width, kTop + kPlotHeight + 18.0, "middle", groups[g].label);
  }
  body += legend(names, kTop + kPlotHeight + 42.0);
  return frame(title, kTop + kPlotHeight + 40.0 + legendHeight(names), body);
}

std::string linePlot(const std::string& title, const std::string& x_axis, const std::string& y_axis,
                     const std::vector<LineSeries>& series) {
  std::vector<double> xs, ys;
  std::vector<std::string> names;
  for (const LineSeries& each : series) {
    names.push_back(each.name);
    for (const auto& point : each.points) {
      xs.push_back(point.first);
      ys.push_back(point.second);
    }
  }
  if (xs.empty()) return "";
  const LogAxis x(*std::min_element(xs.begin(), xs.end()), *std::max_element(xs.begin(), xs.end()),
                  kLeft, kWidth - kRight);
  const LogAxis y(*std::min_element(ys.begin(), ys.end()), *std::max_element(ys.begin(), ys.end()),
                  kTop + kPlotHeight, kTop);
  std::string body = horizontalGrid(y, y_axis);
  for (const double tick : x.ticks()) {
    body += line(x(tick), kTop, x(tick), kTop + kPlotHeight, "class=\"grid\"");
    body += text(x(tick), kTop + kPlotHeight + 16.0, "middle", shownNumber(tick));
  }
  body += text(kLeft + 0.5 * (kWidth - kLeft), kTop + kPlotHeight + 34.0, "middle", x_axis);
  for (std::size_t s = 0; s < series.size(); ++s) {
    std::vector<std::pair<double, double>> points = series[s].points;
    std::sort(points.begin(), points.end());
    std::ostringstream places;
    std::string marks;
    for (const auto& point : points) {
      places << x(point.first) << ',' << y(point.second) << ' ';
      marks += "<circle" + attribute("cx", x(point.first)) + attribute("cy", y(point.second)) +
               " r=\"3.5\" fill=\"" + seriesColour(s) + "\"><title>" +
               escaped(series[s].name + ": " + shownNumber(point.first) + ", " +
                       shownNumber(point.second)) +
               "</title></circle>";
    }
    body += "<polyline fill=\"none\" stroke-width=\"2\" " + strokeOf(s) + " points=\"" +
            places.str() + "\"/>" + marks;
  }
  body += legend(names, kTop + kPlotHeight + 58.0);
  return frame(title, kTop + kPlotHeight + 56.0 + legendHeight(names), body);
}

}  // namespace grid_path_planner::study
