#include "study/report/svg_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grid_path_planner::study {
namespace {

std::size_t countOf(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// Lengths of flights from 107 to 187 m were drawn on an axis that named 100 only.
TEST(SvgChartLaw, EachAxisNamesTwoValuesOrMore) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> decades(-3.0, 6.0), length(0.0, 5.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double least = std::pow(10.0, decades(random));
    const double most = least * std::pow(10.0, length(random));
    const std::string chart = boxPlot("Length", "m", {{"LHLM", {{"safe", {least, most}}}}});
    EXPECT_GE(countOf("class=\"grid\"", chart), 2U) << least << " to " << most;
    EXPECT_LE(countOf("class=\"grid\"", chart), 12U) << least << " to " << most;
  }
}

}  // namespace
}  // namespace grid_path_planner::study
