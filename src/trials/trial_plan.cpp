#include "trials/trial_plan.h"

#include <algorithm>
#include <sstream>

#include "grid_path_planner/base/files.h"
#include "sources_hash.h"
#include "trials/trial_record.h"

namespace grid_path_planner::trials {

namespace {

constexpr int kFramesOfUnit = 25;
constexpr std::size_t kLargestFile = std::size_t{256} << 20;

}  // namespace

std::uint64_t fingerprintOf(const std::vector<std::string>& files, const std::string& more) {
  std::ostringstream text;
  text << kSourcesHash << more;
  for (const std::string& file : files) text << base::readWholeFile(file, kLargestFile);
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char letter : text.str())
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  return hash;
}

TrialPlan::TrialPlan(TrialStudy study) : study_(std::move(study)) {
  const int all = frameCount(study_);
  for (const Water water : {Water::TURBID, Water::CLEAR})
    for (int first = 0; first < all; first += kFramesOfUnit)
      units_.push_back({true, water, first, std::min(kFramesOfUnit, all - first)});
  rendering_ = units_.size();
  std::vector<int> seeds = {kShownSeed};
  for (int i = 0; i < study_.seeds; ++i) seeds.push_back(study_.first_seed + i);
  for (const int seed : seeds)  // so that a study that is interrupted has as many runs of each set
    for (std::size_t set = 0; set < study_.sets.size(); ++set)
      units_.push_back({false, Water::TURBID, 0, 0, set, seed});
}

std::string TrialPlan::nameOf(const TrialUnit& unit) const {
  if (!unit.renders)
    return study_.sets[unit.set].name + '/' +
           (unit.seed == kShownSeed ? "images" : std::to_string(unit.seed));
  return "images " + std::to_string(unit.first_frame) + " to " +
         std::to_string(unit.first_frame + unit.frames - 1) +
         (unit.water == Water::TURBID ? " in turbid water" : " in clear water");
}

// Whatever is in the study file counts, comments too.
std::uint64_t TrialPlan::fingerprint() const {
  return fingerprintOf({study_.file, study_.world, study_.layout}, "");
}

}  // namespace grid_path_planner::trials
