#include "study/study_planners.h"

#include "study/eager_theta_star.h"
#include "study/published_a_star.h"

namespace grid_path_planner::study {

using planners::checkSearchOptions, planners::makePlanner, planners::memoryLimitOf,
    planners::Planner, planners::SearchOptions, planners::TieBreak, planners::traitsOf;

namespace {

// The published tie-break orders cells by their estimates alone.
SearchOptions withoutTieBreak(SearchOptions options) {
  options.tie_break = TieBreak::NONE;
  return options;
}

// Planners that let A* answer where a tie-break is asked for.
bool leftToAStar(const std::string& planner) {
  return planner == "a_star" || planner == "weighted_jump_point";
}

// None where it is one of the package's.
std::unique_ptr<Planner> ownPlanner(const std::string& name, const SearchOptions& options,
                                    bool published_cross) {
  if (name == EagerThetaStar::kName) return std::make_unique<EagerThetaStar>();
  if (name == PublishedAStar::kName)
    return std::make_unique<PublishedAStar>(published_cross ? withoutTieBreak(options) : options,
                                            published_cross);
  if (published_cross && leftToAStar(name))
    return std::make_unique<PublishedAStar>(withoutTieBreak(options));
  return nullptr;
}

}  // namespace

const std::vector<std::pair<const char*, StudyTieBreak>>& choicesOf(StudyTieBreak) {
  static const std::vector<std::pair<const char*, StudyTieBreak>> choices = {
      {"none", StudyTieBreak::NONE},
      {"larger_g", StudyTieBreak::LARGER_G},
      {"cross_product", StudyTieBreak::CROSS_PRODUCT},
      {"cross_product_published", StudyTieBreak::CROSS_PRODUCT_PUBLISHED}};
  return choices;
}

TieBreak orderOf(StudyTieBreak tie_break) {
  switch (tie_break) {
    case StudyTieBreak::NONE:
      return TieBreak::NONE;
    case StudyTieBreak::LARGER_G:
      return TieBreak::LARGER_G;
    case StudyTieBreak::CROSS_PRODUCT:
    case StudyTieBreak::CROSS_PRODUCT_PUBLISHED:
      break;
  }
  return TieBreak::CROSS_PRODUCT;
}

std::unique_ptr<Planner> makeStudyPlanner(const std::string& name, const SearchOptions& options,
                                          bool published_cross) {
  std::unique_ptr<Planner> own = ownPlanner(name, options, published_cross);
  if (!own) return makePlanner(name, options);
  checkSearchOptions(options);
  own->limitMemory(memoryLimitOf(options));
  return own;
}

bool guidedInStudies(const std::string& planner) {
  if (planner == EagerThetaStar::kName) return false;
  return planner == PublishedAStar::kName || traitsOf(planner).heuristic;
}

bool inStudiesOnly(const std::string& planner, bool published_cross) {
  return planner == EagerThetaStar::kName || planner == PublishedAStar::kName ||
         (published_cross && leftToAStar(planner));
}

}  // namespace grid_path_planner::study
