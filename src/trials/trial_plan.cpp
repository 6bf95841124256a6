#include "trials/trial_plan.h"

#include <algorithm>

#include "grid_path_planner/simulation/world.h"
#include "simulation/mesh_bytes.h"
#include "sources_hash.h"
#include "trials/trial_record.h"

namespace grid_path_planner::trials {

namespace {

constexpr int kFramesOfUnit = 25;

}  // namespace

study::Fingerprint fingerprintOf(const std::string& file) {
  study::Fingerprint print;
  print.addText(kSourcesHash);
  print.addFile(file);
  return print;
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

// Whatever is in the study file counts, comments too; of the world what is read of it and of the meshes that it names.
std::uint64_t TrialPlan::fingerprint() const {
  study::Fingerprint print = fingerprintOf(study_.file);
  print.addFile(study_.layout);
  const auto world = simulation::readWorld(study_.world, base::ReadLimits::ofProcessorTime());
  print.addText(bytesOf(simulation::WorldMeshes{world.solid(), world.visible()}));
  return print.value();
}

}  // namespace grid_path_planner::trials
