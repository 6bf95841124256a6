#include "study/study_plan.h"

#include <sstream>
#include <utility>

#include "grid_path_planner/base/option_text.h"
#include "sources_hash.h"
#include "study/fingerprint.h"
#include "study/unfilled_border.h"

namespace grid_path_planner::study {

using base::choiceName, base::optionText;
using grid::GridGeometry, grid::OccupancyGrid;

namespace {

void addMap(const OccupancyGrid& map, Fingerprint& print) {
  const GridGeometry& geometry = map.geometry();
  print.addNumber(std::int64_t{geometry.width()});
  print.addNumber(std::int64_t{geometry.height()});
  for (const double number :
       {geometry.resolution(), geometry.origin().x, geometry.origin().y, geometry.origin().yaw})
    print.addNumber(number);
  print.addText(std::string(reinterpret_cast<const char*>(map.row(0)), geometry.size()));
}

std::string placesOf(const StudyQuery& query) {
  std::ostringstream out;
  out << query.start << " to " << query.goal;
  return out.str();
}

}  // namespace

StudyPlan::StudyPlan(Study study, const MapReader& read_map) : study_(std::move(study)) {
  for (const StudyMap& map : study_.maps) {
    maps_.push_back(std::make_shared<const OccupancyGrid>(read_map(map.file)));
    queries_.push_back(studyQueries(map, *maps_.back(), study_.base.costmap));
  }
  for (std::size_t setting = 0; setting < study_.settings.size(); ++setting)
    for (std::size_t query = 0; query < queries_[study_.settings[setting].map].size(); ++query)
      units_.push_back({setting, query});
}

std::shared_ptr<const OccupancyGrid> StudyPlan::mapOf(const StudySetting& setting) const {
  if (setting.border == Border::FILLED) return maps_[setting.map];
  return std::make_shared<const OccupancyGrid>(
      withUnfilledBorder(*maps_[setting.map], setting.costmap.kernel));
}

std::string StudyPlan::nameOf(const StudyUnit& unit) const {
  const StudySetting& setting = study_.settings[unit.setting];
  return setting.label + ", " + placesOf(queries_[setting.map][unit.query]);
}

std::uint64_t StudyPlan::fingerprint() const {
  Fingerprint print;
  print.addText(kSourcesHash);
  print.addNumber(std::int64_t{study_.repeats});
  print.addText(optionText(study_.base));
  for (const StudySetting& setting : study_.settings) {
    print.addNumber(static_cast<std::int64_t>(setting.map));
    print.addText(optionText(setting.costmap));
    print.addText(choiceName(setting.border));
  }
  for (const StudyVariant& variant : study_.variants) {
    print.addText(variant.planner);
    print.addText(optionText(variant.search));
    if (variant.published_cross) print.addText("cross_product_published");
  }
  for (std::size_t map = 0; map < maps_.size(); ++map) {
    addMap(*maps_[map], print);
    for (const StudyQuery& query : queries_[map]) print.addText(placesOf(query));
  }
  return print.value();
}

}  // namespace grid_path_planner::study
