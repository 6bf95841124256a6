#include "flights/flight_plan.h"

#include <filesystem>
#include <sstream>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/mesh_bytes.h"
#include "sources_hash.h"
#include "study/fingerprint.h"

namespace grid_path_planner::flights {

using base::InputError, base::optionText;
using study::Fingerprint;

namespace {

void addVariant(const FlightVariant& variant, Fingerprint& print) {
  print.addText(variant.name);
  print.addNumber(std::int64_t{variant.first_seed});
  print.addNumber(std::int64_t{variant.flights});
  print.addText(optionText(variant.pilot));
  for (const std::string& word : variant.program) {
    print.addText(word);
    std::error_code nothing_there;
    if (std::filesystem::is_regular_file(word, nothing_there)) print.addFile(word);
  }
}

// As it is flown in: with the meshes and models that its file names, wherever they lie.
void addWorld(const FlightWorld& world, Fingerprint& print) {
  const auto read = simulation::readWorld(world.file, base::ReadLimits::ofProcessorTime());
  print.addText(world.name);
  print.addText(bytesOf(simulation::WorldMeshes{read.solid(), read.visible()}));
}

void describeBody(const simulation::MovingBody& body, std::ostream& text) {
  text << body.name << base::choiceName(body.shape) << body.half_size.transpose();
  for (const auto& knot : body.track) text << ' ' << knot.time << ' ' << knot.position.transpose();
}

}  // namespace

FlightPlan::FlightPlan(FlightStudy study) : study_(std::move(study)) {
  for (std::size_t variant = 0; variant < study_.variants.size(); ++variant)
    for (std::size_t world = 0; world < study_.worlds.size(); ++world)
      for (int i = 0; i < study_.variants[variant].flights; ++i)
        units_.push_back({variant, world, study_.variants[variant].first_seed + i});
}

std::string FlightPlan::nameOf(const FlightUnit& unit) const {
  const FlightVariant& variant = study_.variants[unit.variant];
  return variant.name + '/' + std::to_string(unit.seed) + '/' + variant.rules() +
         (study_.worlds.size() > 1 ? '/' + study_.worlds[unit.world].name : "");
}

FlightUnit FlightPlan::unitOf(const std::string& name) const {
  for (const FlightUnit& unit : units_)
    if ((nameOf(unit) + '/').compare(0, name.size() + 1, name + '/') == 0) return unit;
  throw InputError(study_.file, "has no flight '" + name + "'; they are called " +
                                    nameOf(units_.front()) + " to " + nameOf(units_.back()));
}

std::uint64_t FlightPlan::fingerprint() const {
  Fingerprint print;
  print.addText(kSourcesHash);
  for (const FlightVariant& variant : study_.variants) addVariant(variant, print);
  std::ostringstream text;
  text.precision(17);
  for (const auto& body : study_.bodies) describeBody(body, text);
  text << optionText(study_.vehicle) << optionText(study_.camera) << optionText(study_.odometry)
       << study_.command_rate << ' ' << study_.start.transpose() << ' ' << study_.start_yaw << ' '
       << study_.start_shift << ' ' << study_.yaw_shift << ' ' << study_.fence_low << ' '
       << study_.fence_high << ' ' << study_.time_limit;
  for (const auto& place : study_.route) text << ' ' << place.transpose();
  print.addText(text.str());
  for (const FlightWorld& world : study_.worlds) addWorld(world, print);
  return print.value();
}

}  // namespace grid_path_planner::flights
