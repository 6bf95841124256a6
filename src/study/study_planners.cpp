#include "study/study_planners.h"

#include <algorithm>
#include <array>

#include "study/programs/eager_theta_star.h"
#include "study/programs/published_a_star.h"
#include "study/programs/published_dijkstra.h"

namespace grid_path_planner::study {

using base::InputError;
using planners::checkSearchOptions, planners::makePlanner, planners::memoryLimitOf,
    planners::Planner, planners::SearchOptions, planners::TieBreak, planners::traitsOf;

namespace {

struct PublishedProgram {
  const char* name;
  PublishedAStar::Variation variation;
};

constexpr std::array<PublishedProgram, 3> kPublishedAStars = {{
    {"a_star_published", {true, false, false}},
    {"a_star_published_crossing", {false, false, false}},
    {"a_star_published_values", {false, true, false}},
}};

// Null where it is none of them.
const PublishedProgram* publishedAStar(const std::string& name) {
  const auto* found =
      std::find_if(kPublishedAStars.begin(), kPublishedAStars.end(),
                   [&name](const PublishedProgram& program) { return name == program.name; });
  return found == kPublishedAStars.end() ? nullptr : found;
}

// None where it is one of the package's.
std::unique_ptr<Planner> ownPlanner(const std::string& name, const SearchOptions& options,
                                    bool published_cross) {
  if (const PublishedProgram* program = publishedAStar(name)) {
    PublishedAStar::Variation variation = program->variation;
    variation.published_cross = published_cross;
    return std::make_unique<PublishedAStar>(program->name, options, variation);
  }
  if (published_cross)
    throw InputError(
        "tie_break cross_product_published is for a_star_published and its variations, "
        "not for " +
        name);
  if (name == EagerThetaStar::kName) return std::make_unique<EagerThetaStar>();
  if (name == PublishedDijkstra::kName) return std::make_unique<PublishedDijkstra>();
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

bool isPublishedAStar(const std::string& planner) {
  return publishedAStar(planner) != nullptr;
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
  if (isPublishedAStar(planner)) return true;
  return !inStudiesOnly(planner) && traitsOf(planner).heuristic;
}

bool inStudiesOnly(const std::string& planner) {
  return planner == EagerThetaStar::kName || planner == PublishedDijkstra::kName ||
         isPublishedAStar(planner);
}

}  // namespace grid_path_planner::study
