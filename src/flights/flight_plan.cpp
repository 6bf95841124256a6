#include "flights/flight_plan.h"

#include <sstream>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/option_text.h"
#include "sources_hash.h"

namespace grid_path_planner::flights {

using base::InputError, base::optionText;

namespace {

constexpr std::size_t kLargestWorld = std::size_t{256} << 20;

void describeVariant(const FlightVariant& variant, std::ostream& text) {
  text << variant.name << ' ' << variant.first_seed << ' ' << variant.flights << '\n'
       << optionText(variant.pilot);
  for (const std::string& word : variant.program) text << word << '\n';
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
  std::ostringstream text;
  text.precision(17);
  text << kSourcesHash << '\n';
  for (const FlightVariant& variant : study_.variants) describeVariant(variant, text);
  for (const auto& body : study_.bodies) describeBody(body, text);
  text << optionText(study_.vehicle) << optionText(study_.camera) << optionText(study_.odometry)
       << study_.command_rate << ' ' << study_.start.transpose() << ' ' << study_.start_yaw << ' '
       << study_.start_shift << ' ' << study_.yaw_shift << ' ' << study_.fence_low << ' '
       << study_.fence_high << ' ' << study_.time_limit;
  for (const auto& place : study_.route) text << ' ' << place.transpose();
  for (const FlightWorld& world : study_.worlds)
    text << world.name << base::readWholeFile(world.file, kLargestWorld);
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char letter : text.str())
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  return hash;
}

}  // namespace grid_path_planner::flights
