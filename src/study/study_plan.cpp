#include "study/study_plan.h"

#include <sstream>
#include <utility>

#include "grid_path_planner/base/option_text.h"
#include "study/unfilled_border.h"

namespace grid_path_planner::study {

using base::choiceName, base::optionText;
using grid::GridGeometry, grid::OccupancyGrid;

namespace {

// FNV-1a (Fowler, Noll & Vo 1991).
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ull;
  }
  void add(const std::string& text) {
    add(text.data(), text.size());
    add("\n", 1);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

template <class Options>
void addOptions(Hash& hash, const Options& options) {
  hash.add(optionText(options));
}

void addMap(Hash& hash, const OccupancyGrid& map) {
  const GridGeometry& geometry = map.geometry();
  std::ostringstream text;
  text.precision(17);
  text << geometry.width() << ' ' << geometry.height() << ' ' << geometry.resolution() << ' '
       << geometry.origin().x << ' ' << geometry.origin().y << ' ' << geometry.origin().yaw;
  hash.add(text.str());
  hash.add(map.row(0), geometry.size());
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
  Hash hash;
  hash.add(std::to_string(study_.repeats));
  addOptions(hash, study_.base);
  for (const StudySetting& setting : study_.settings) {
    addOptions(hash, setting.costmap);
    hash.add(choiceName(setting.border));
  }
  for (const StudyVariant& variant : study_.variants) {
    hash.add(variant.planner);
    addOptions(hash, variant.search);
    if (variant.published_cross) hash.add("cross_product_published");
  }
  for (std::size_t map = 0; map < maps_.size(); ++map) {
    addMap(hash, *maps_[map]);
    for (const StudyQuery& query : queries_[map]) hash.add(placesOf(query));
  }
  return hash.value();
}

}  // namespace grid_path_planner::study
