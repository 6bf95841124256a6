#include "flights/report/flight_data.h"

#include <algorithm>

#include "base/shell_text.h"

namespace grid_path_planner::flights {

FlightData::FlightData(const FlightPlan& plan, std::vector<FlightRecord> records)
    : plan_(plan), records_(std::move(records)), by_variant_(plan.study().variants.size()) {
  for (const FlightRecord& record : records_) by_variant_[record.variant].push_back(&record);
}

std::string FlightData::nameOf(const FlightRecord& record) const {
  return plan_.nameOf({record.variant, record.world, record.seed});
}

std::string FlightData::commandOf(const FlightRecord& record, const std::string& command) const {
  return command + " --flight " + base::shellWord(nameOf(record));
}

std::size_t FlightData::count(std::size_t variant, FlightEnd end) const {
  const auto& flights = of(variant);
  return static_cast<std::size_t>(
      std::count_if(flights.begin(), flights.end(),
                    [end](const FlightRecord* each) { return each->end == end; }));
}

std::size_t FlightData::successes(std::size_t variant) const {
  return count(variant, FlightEnd::HOME);
}

std::vector<double> FlightData::values(
    std::size_t variant, const std::function<double(const FlightRecord&)>& value) const {
  std::vector<double> values;
  for (const FlightRecord* record : of(variant))
    if (record->success()) values.push_back(value(*record));
  return values;
}

std::optional<std::size_t> FlightData::variantOf(const std::string& name,
                                                 const std::string& rules) const {
  for (std::size_t i = 0; i < study().variants.size(); ++i)
    if (study().variants[i].name == name && study().variants[i].rules() == rules) return i;
  return std::nullopt;
}

std::vector<std::string> FlightData::rules() const {
  std::vector<std::string> rules;
  for (const FlightVariant& variant : study().variants)
    if (std::find(rules.begin(), rules.end(), variant.rules()) == rules.end())
      rules.push_back(variant.rules());
  return rules;
}

}  // namespace grid_path_planner::flights
