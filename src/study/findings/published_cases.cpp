#include "study/findings/published_cases.h"

#include <algorithm>
#include <numeric>

namespace grid_path_planner::study {

using base::Status;
using planners::Heuristic;

const StudyRun* PublishedCase::found(std::size_t variant) const {
  const StudyRun* run = (*unit)[variant];
  return run != nullptr && run->status == Status::FOUND ? run : nullptr;
}

std::vector<PublishedCase> publishedCases(const StudyData& data, const std::string& group,
                                          Border border) {
  const StudyPlan& plan = data.plan();
  const std::string& weights = data.study().settings.front().weights;
  std::vector<PublishedCase> cases;
  for (std::size_t i = 0; i < plan.units().size(); ++i) {
    const StudySetting& setting = data.study().settings[plan.units()[i].setting];
    const StudyQuery& query = plan.queries(setting.map)[plan.units()[i].query];
    if (query.group == group && query.number > 0 && setting.border == border &&
        setting.weights == weights)
      cases.push_back({&data.units()[i], &setting, query.number});
  }
  return cases;
}

const PublishedCase* sameCase(const std::vector<PublishedCase>& cases, const PublishedCase& as) {
  const auto same = std::find_if(cases.begin(), cases.end(), [&as](const PublishedCase& each) {
    return each.number == as.number && each.setting->map == as.setting->map &&
           each.setting->costmap.kernel == as.setting->costmap.kernel;
  });
  return same == cases.end() ? nullptr : &*same;
}

std::optional<std::size_t> variantOf(const StudyData& data, const std::string& planner,
                                     std::optional<Heuristic> heuristic) {
  const std::vector<StudyVariant>& variants = data.study().variants;
  for (std::size_t i = 0; i < variants.size(); ++i)
    if (variants[i].planner == planner && !variants[i].published_cross &&
        (!heuristic || variants[i].search.heuristic == *heuristic))
      return i;
  return {};
}

std::vector<std::size_t> heuristicsOf(const StudyData& data, const std::string& planner) {
  std::vector<std::size_t> found;
  const std::vector<StudyVariant>& variants = data.study().variants;
  for (std::size_t i = 0; i < variants.size(); ++i)
    if (variants[i].planner == planner && variants[i].label != planner &&
        !variants[i].published_cross)
      found.push_back(i);
  return found;
}

std::map<int, double> MeansByNumber::means() const {
  std::map<int, double> means;
  for (const auto& [number, values] : values_)
    means[number] =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return means;
}

std::vector<double> MeansByNumber::values() const {
  std::vector<double> all;
  for (const auto& mean : means()) all.push_back(mean.second);
  return all;
}

std::vector<double> MeansByNumber::differences(const MeansByNumber& a, const MeansByNumber& b) {
  std::vector<double> all;
  const std::map<int, double> others = b.means();
  for (const auto& [number, mean] : a.means())
    if (others.count(number) != 0) all.push_back(mean - others.at(number));
  return all;
}

}  // namespace grid_path_planner::study
