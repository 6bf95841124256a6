// The output of engine_growth: Markdown, CSV and charts.
#pragma once

#include <algorithm>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "study/report/svg_chart.h"

namespace grid_path_planner::benchmark {

// One planner on one map.
struct Case {
  std::string planner;
  int side = 0;
  double density = 0.0;
  std::string weights;
};

struct Growth {
  Case of;
  std::string status = "lost";  // what the child said before it ended
  double prepare_s = 0.0;
  double first_s = 0.0;
  double plan_s = 0.0;
  double second_s = 0.0;
  double cost = 0.0;
  double expanded = 0.0;
  double search_bytes = 0.0;
  double peak_bytes = 0.0;
  std::string message;

  bool found() const { return status == "FOUND"; }
  double cells() const { return static_cast<double>(of.side) * of.side; }
};

inline std::vector<std::string> partsOf(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

inline void printHead(std::ostream& out) {
  out << "\n| planner | side | density | weights | status | prepare s | first plan ms | plan ms | "
         "second query µs "
         "| "
         "expanded | search bytes a cell | peak MB "
         "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

inline void print(std::ostream& out, const Growth& g) {
  out << "| " << g.of.planner << " | " << g.of.side << " | " << g.of.density << " | "
      << g.of.weights << " | " << (g.status == "INVALID_REQUEST" ? g.message : g.status) << " | ";
  if (g.found())
    out << g.prepare_s << " | " << g.first_s * 1e3 << " | " << g.plan_s * 1e3 << " | "
        << g.second_s * 1e6 << " | " << g.expanded << " | " << g.search_bytes / g.cells() << " | ";
  else
    out << "| | | | | | ";
  out << g.peak_bytes / 1e6 << " |\n" << std::flush;
}

inline std::string withoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

inline std::string csvOf(const std::vector<Growth>& all) {
  std::ostringstream out;
  out << "planner,side,density,weights,status,prepare_s,first_s,plan_s,second_s,cost,expanded,"
         "search_bytes,"
         "peak_bytes,message\n";
  out.precision(9);
  for (const Growth& g : all)
    out << g.of.planner << ',' << g.of.side << ',' << g.of.density << ',' << g.of.weights << ','
        << g.status << ',' << g.prepare_s << ',' << g.first_s << ',' << g.plan_s << ','
        << g.second_s << ',' << g.cost << ',' << g.expanded << ',' << g.search_bytes << ','
        << g.peak_bytes << ',' << withoutCommas(g.message) << '\n';
  return out.str();
}

// What csvOf() wrote.
inline std::vector<Growth> readCsv(const std::string& file) {
  std::vector<Growth> all;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const std::vector<std::string> parts = partsOf(line);
    if (parts.size() < 13) throw base::InputError(file, "'" + line + "' is no line of such a file");
    Growth growth;
    growth.of = {parts[0], static_cast<int>(base::numberFromText(file, parts[1])),
                 base::numberFromText(file, parts[2]), parts[3]};
    growth.status = parts[4];
    growth.plan_s = base::numberFromText(file, parts[7]);
    growth.second_s = base::numberFromText(file, parts[8]);
    growth.peak_bytes = base::numberFromText(file, parts[12]);
    all.push_back(growth);
  }
  if (all.empty()) throw base::InputError(file, "has no measurements");
  return all;
}

// The lines of a chart: `x` and `y` of what was found, a line a planner.
template <class X, class Y>
std::vector<study::LineSeries> seriesOf(const std::vector<Growth>& all, const X& x, const Y& y) {
  std::vector<study::LineSeries> series;
  for (const Growth& growth : all) {
    if (!growth.found()) continue;
    auto same = std::find_if(
        series.begin(), series.end(),
        [&growth](const study::LineSeries& each) { return each.name == growth.of.planner; });
    if (same == series.end()) same = series.insert(same, {growth.of.planner, {}});
    const double place = x(growth);
    const bool known = std::any_of(same->points.begin(), same->points.end(),
                                   [place](const auto& point) { return point.first == place; });
    if (!known) same->points.emplace_back(place, std::max(y(growth), 1e-9));
  }
  return series;
}

inline std::string htmlOf(const std::vector<Growth>& by_side, const std::vector<Growth>& by_density,
                          const std::string& weights, double density_side) {
  const auto side = [](const Growth& g) { return static_cast<double>(g.of.side); };
  const auto density = [](const Growth& g) { return g.of.density * 100.0; };
  const auto plan_ms = [](const Growth& g) { return g.plan_s * 1e3; };
  const auto peak_mb = [](const Growth& g) { return g.peak_bytes / 1e6; };
  const std::string map = weights == "rings" ? "obstacles with rings of weights" : "obstacles";
  std::ostringstream out;
  out << "<!doctype html><meta charset=\"utf-8\"><title>How cost "
         "grows</title><style>body{margin:8px;"
         "background:#fff;width:1560px;display:grid;grid-template-columns:1fr 1fr;gap:12px}"
         "svg{width:100%;font:12px system-ui,sans-serif}.grid{stroke:#ddd}"
         ".chart-title{font-weight:600;font-size:14px}</style>\n"
      << study::linePlot("Corner to corner, " + map + " on 10 % of the area",
                         "side of the map, cells", "plan, ms", seriesOf(by_side, side, plan_ms))
      << study::linePlot("Peak memory of the process, map included", "side of the map, cells", "MB",
                         seriesOf(by_side, side, peak_mb));
  std::ostringstream title;
  title << "Corner to corner on " << density_side << "x" << density_side;
  out << study::linePlot(title.str() + ", " + map, "share of the area under obstacles, %",
                         "plan, ms", seriesOf(by_density, density, plan_ms))
      << study::linePlot("A second query, between neighbours, right after that",
                         "side of the map, cells", "µs",
                         seriesOf(by_side, side, [](const Growth& g) { return g.second_s * 1e6; }))
      << '\n';
  return out.str();
}

}  // namespace grid_path_planner::benchmark
