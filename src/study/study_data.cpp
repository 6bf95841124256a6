#include "study/study_data.h"

#include <algorithm>
#include <cmath>

#include "study/study_planners.h"

namespace grid_path_planner::study {

using base::Status;

double medianTime(const StudyRun& run) {
  return quantileOf(run.times_ms, 0.5);
}

void RatiosByQuery::add(const QueryKey& query, double numerator, double denominator) {
  if (numerator > 0.0 && denominator > 0.0)
    logarithms_[query].push_back(std::log(numerator / denominator));
}

std::vector<double> RatiosByQuery::values() const {
  std::vector<double> values;
  for (const auto& query : logarithms_) {
    double sum = 0.0;
    for (const double logarithm : query.second) sum += logarithm;
    values.push_back(std::exp(sum / static_cast<double>(query.second.size())));
  }
  return values;
}

StudyData::StudyData(const StudyPlan& plan, const std::vector<StudyRun>& runs)
    : plan_(plan), runs_(runs) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> place;
  for (const StudyUnit& unit : plan.units()) {
    place[{unit.setting, unit.query}] = units_.size();
    units_.emplace_back(study().variants.size(), nullptr);
  }
  for (const StudyRun& run : runs) units_[place.at({run.setting, run.query})][run.variant] = &run;
}

std::size_t StudyData::queries() const {
  std::size_t all = 0;
  for (std::size_t map = 0; map < study().maps.size(); ++map) all += plan_.queries(map).size();
  return all;
}

ProblemSize StudyData::sizeOf(std::size_t setting) const {
  const StudySetting& chosen = study().settings[setting];
  return {chosen.map, chosen.costmap.kernel, chosen.costmap.kernel_rule, chosen.border};
}

std::vector<ProblemSize> StudyData::sizes() const {
  std::vector<ProblemSize> sizes;
  for (std::size_t setting = 0; setting < study().settings.size(); ++setting) {
    const ProblemSize size = sizeOf(setting);
    const bool known = std::find(sizes.begin(), sizes.end(), size) != sizes.end();
    if (!known) sizes.push_back(size);
  }
  return sizes;
}

std::size_t StudyData::baseline() const {
  for (std::size_t variant = 0; variant < study().variants.size(); ++variant)
    if (study().variants[variant].planner == "dijkstra") return variant;
  return 0;
}

std::size_t StudyData::baselineOf(std::size_t variant) const {
  const std::vector<StudyVariant>& variants = study().variants;
  const bool published = inStudiesOnly(variants[variant].planner);
  std::size_t first = variants.size();
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const bool same_kind = published ? variants[i].planner == variants[variant].planner
                                     : !inStudiesOnly(variants[i].planner);
    if (!same_kind) continue;
    if (variants[i].planner == "dijkstra") return i;
    first = std::min(first, i);
  }
  return first;
}

std::vector<double> StudyData::ratios(std::size_t a, std::size_t b, const ProblemSize* size,
                                      const std::function<double(const StudyRun&)>& value) const {
  RatiosByQuery all;
  for (const UnitRow& unit : units_) {
    const StudyRun *first = unit[a], *second = unit[b];
    if (first == nullptr || second == nullptr) continue;
    if (first->status != Status::FOUND || second->status != Status::FOUND) continue;
    const ProblemSize of = sizeOf(first->setting);
    if (size != nullptr && of != *size) continue;
    all.add(queryOf(*first), value(*first), value(*second));
  }
  return all.values();
}

std::vector<double> mediansOf(const StudyData& data, const ProblemSize& size, std::size_t variant) {
  std::vector<double> times;
  for (const UnitRow& unit : data.units()) {
    const StudyRun* run = unit[variant];
    if (run == nullptr || run->status != Status::FOUND) continue;
    const ProblemSize of = data.sizeOf(run->setting);
    if (of == size) times.push_back(medianTime(*run));
  }
  return times;
}

double blocksOf(const StudyData& data, const ProblemSize& size) {
  const grid::GridGeometry& geometry = data.plan().map(size.map)->geometry();
  const auto side = [&size](int cells) {
    return std::ceil(static_cast<double>(cells) / size.kernel);
  };
  return side(geometry.width()) * side(geometry.height());
}

}  // namespace grid_path_planner::study
