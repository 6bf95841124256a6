// Texts and cells that several findings use.
#pragma once

#include <string>
#include <vector>

#include "study/confidence.h"
#include "study/report/table.h"
#include "study/study_data.h"

namespace grid_path_planner::study {

inline std::string percentText(double share) {
  return shownNumber(100.0 * share) + " %";
}

// "2.31 (2.02 to 2.64)"
inline std::string intervalText(const Interval& interval) {
  return shownNumber(interval.value) + " (" + shownNumber(interval.low) + " to " +
         shownNumber(interval.high) + ")";
}

inline TableCell intervalCell(const Interval& interval) {
  TableCell cell(intervalText(interval));
  cell.number = interval.value;
  return cell;
}

inline TableCell shareCell(std::size_t some, std::size_t all, std::size_t samples) {
  if (all == 0) return "–";
  const Interval interval = share(some, all, samples);
  TableCell cell(percentText(interval.value) + " (" + percentText(interval.low) + " to " +
                 percentText(interval.high) + ")");
  cell.number = interval.value;
  return cell;
}

inline std::string sizeText(const StudyData& data, const ProblemSize& size) {
  std::string text = "kernel " + std::to_string(size.kernel);
  if (size.border == Border::UNFILLED) text += ", border unfilled";
  if (data.study().maps.size() > 1) text = data.study().maps[size.map].name + ", " + text;
  return text;
}

// The median of `values`, or a dash without values.
inline TableCell medianCell(const std::vector<double>& values) {
  if (values.empty()) return "–";
  return TableCell(quantileOf(values, 0.5), 3);
}

}  // namespace grid_path_planner::study
