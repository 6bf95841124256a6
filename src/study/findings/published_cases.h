// The runs of the published queries: what the published counts are repeated with.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/study_data.h"

namespace grid_path_planner::study {

// One query of a group on one setting.
struct PublishedCase {
  const UnitRow* unit;
  const StudySetting* setting;
  int number;  // of the query in its group, from 1

  // Null where the variant has no path.
  const StudyRun* found(std::size_t variant) const;
};

// Those of `group` on settings with the first weights and this border; in the order of the plan.
std::vector<PublishedCase> publishedCases(const StudyData& data, const std::string& group,
                                          Border border);

// The one of `cases` that is the same query on the same map at the same kernel; null where none is.
const PublishedCase* sameCase(const std::vector<PublishedCase>& cases, const PublishedCase& as);

// The first variant of a planner, with a heuristic where one is given; none where there is none.
std::optional<std::size_t> variantOf(const StudyData& data, const std::string& planner,
                                     std::optional<planners::Heuristic> heuristic = {});

// The variants of a planner that differ in the heuristic, in the order of the study.
std::vector<std::size_t> heuristicsOf(const StudyData& data, const std::string& planner);

// One value for each query number: the mean of those added to it.
class MeansByNumber {
 public:
  void add(int number, double value) { values_[number].push_back(value); }
  std::vector<double> values() const;
  // Of `a` - `b` for the numbers that both have.
  static std::vector<double> differences(const MeansByNumber& a, const MeansByNumber& b);

 private:
  std::map<int, double> means() const;
  std::map<int, std::vector<double>> values_;
};

}  // namespace grid_path_planner::study
