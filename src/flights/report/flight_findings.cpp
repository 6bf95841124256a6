#include "flights/report/flight_findings.h"

#include <algorithm>
#include <cmath>

#include "study/confidence.h"

namespace grid_path_planner::flights {

using study::Finding, study::Interval, study::shownNumber, study::Table, study::TableCell;

namespace {

// "80.1 (78.9 to 81.3), n 19"
TableCell meanCell(const std::vector<double>& values) {
  if (values.empty()) return "–";
  const Interval mean = study::meanDifference(values);
  TableCell cell(shownNumber(mean.value, 4) +
                 (values.size() > 1
                      ? " (" + shownNumber(mean.low, 4) + " to " + shownNumber(mean.high, 4) + ")"
                      : "") +
                 ", n " + std::to_string(values.size()));
  cell.number = mean.value;
  return cell;
}

std::string percentOf(double share) {
  return shownNumber(100.0 * share) + " %";
}

TableCell successCell(std::size_t some, std::size_t all) {
  if (all == 0) return "–";
  const Interval interval = study::share(some, all, all);
  TableCell cell(std::to_string(some) + " of " + std::to_string(all) + ", " +
                 percentOf(interval.value) + " (" + percentOf(interval.low) + " to " +
                 percentOf(interval.high) + ")");
  cell.number = interval.value;
  return cell;
}

TableCell number(std::size_t count) {
  return {static_cast<double>(count), 6};
}

double leastClearance(const std::vector<const FlightRecord*>& flights) {
  double least = INFINITY;
  for (const FlightRecord* flight : flights) least = std::min(least, flight->clearance_m);
  return least;
}

// The mean over flights of something, whatever became of them.
double meanOver(const std::vector<const FlightRecord*>& flights,
                const std::function<double(const FlightRecord&)>& value) {
  double sum = 0.0;
  for (const FlightRecord* flight : flights) sum += value(*flight);
  return sum / static_cast<double>(flights.size());
}

double largestOver(const std::vector<const FlightRecord*>& flights,
                   const std::function<double(const FlightRecord&)>& value) {
  double largest = 0.0;
  for (const FlightRecord* flight : flights) largest = std::max(largest, value(*flight));
  return largest;
}

// Lengths over L* of the flights that came home, on worlds of which that is known.
std::vector<double> overShortest(const FlightData& data, std::size_t variant) {
  std::vector<double> ratios;
  for (const FlightRecord* flight : data.of(variant)) {
    const auto shortest = data.study().shortest.find(data.study().worlds[flight->world].name);
    if (flight->success() && shortest != data.study().shortest.end())
      ratios.push_back(flight->length_m / shortest->second);
  }
  return ratios;
}

std::string placeText(const Eigen::Vector3d& at) {
  return "(" + shownNumber(at.x()) + ", " + shownNumber(at.y()) + ", " + shownNumber(at.z()) + ")";
}

}  // namespace

Finding figuresFinding(const FlightData& data) {
  Finding finding;
  finding.question = "Who comes home, how fast and how far?";
  finding.table = {"figures",
                   "Success with Wilson's interval; mean time and length of the flights that came "
                   "home with Student's; 95 %. Published metres are another world's: compare order "
                   "and ratios.",
                   {"configuration", "rules", "came home", "published", "time s", "published s",
                    "length m", "published m"},
                   {}};
  for (std::size_t i = 0; i < data.study().variants.size(); ++i) {
    if (data.of(i).empty()) continue;
    const FlightVariant& variant = data.study().variants[i];
    const auto published = data.study().published.find(variant.name);
    const bool known = published != data.study().published.end();
    finding.table.rows.push_back(
        {variant.name, variant.rules(), successCell(data.successes(i), data.of(i).size()),
         known ? TableCell(shownNumber(published->second.success_percent) + " %") : "–",
         meanCell(data.values(i, timeOf)), known ? TableCell(published->second.time_s, 4) : "–",
         meanCell(data.values(i, lengthOf)),
         known ? TableCell(published->second.length_m, 4) : "–"});
    finding.answers.push_back(variant.label() + ": " + finding.table.rows.back()[2].text + '.');
  }
  return finding;
}

Finding safetyFinding(const FlightData& data) {
  Finding finding;
  finding.question = "How do flights end, and how near to harm?";
  finding.table = {
      "ends",
      "Clearance: the least between the vehicle's middle and a surface, by the truth. Unseen: "
      "commands at which the vehicle's ball was in space that no true ray had seen before.",
      {"configuration", "rules", "flights", "home", "contact", "fence", "stuck", "timeout", "lost",
       "failed", "least clearance m", "unseen commands"},
      {}};
  for (std::size_t i = 0; i < data.study().variants.size(); ++i) {
    const auto& flights = data.of(i);
    if (flights.empty()) continue;
    std::vector<TableCell> row = {data.study().variants[i].name, data.study().variants[i].rules(),
                                  number(flights.size())};
    for (const auto& choice : choicesOf(FlightEnd{}))
      row.push_back(number(data.count(i, choice.second)));
    row.emplace_back(leastClearance(flights), 3);
    row.emplace_back(meanOver(flights, [](const FlightRecord& r) { return r.unseen; }) *
                         static_cast<double>(flights.size()),
                     6);
    finding.table.rows.push_back(row);
  }
  return finding;
}

Finding pathsFinding(const FlightData& data) {
  Finding finding;
  finding.question = "How good is the path, and what does it cost?";
  finding.table = {
      "path",
      "Length over L*, the shortest path of any angle that is known of a world; speed: "
      "length over time; both of the flights that came home. CPU ms of a frame, on the "
      "machine of the flights.",
      {"configuration", "rules", "length / L*", "speed m/s", "top speed m/s", "frame mean ms",
       "frame p99 ms, worst flight", "rendering ms"},
      {}};
  for (std::size_t i = 0; i < data.study().variants.size(); ++i) {
    const auto& flights = data.of(i);
    if (flights.empty()) continue;
    finding.table.rows.push_back(
        {data.study().variants[i].name, data.study().variants[i].rules(),
         meanCell(overShortest(data, i)),
         meanCell(data.values(i, [](const FlightRecord& r) { return r.length_m / r.time_s; })),
         TableCell(largestOver(flights, [](const FlightRecord& r) { return r.max_speed; }), 3),
         TableCell(meanOver(flights, [](const FlightRecord& r) { return r.cost.pilot_mean; }), 3),
         TableCell(largestOver(flights, [](const FlightRecord& r) { return r.cost.pilot_p99; }), 3),
         TableCell(meanOver(flights, [](const FlightRecord& r) { return r.cost.camera_mean; }),
                   3)});
  }
  return finding;
}

Finding failuresFinding(const FlightData& data, const std::string& command) {
  Finding finding;
  finding.question = "Which flights did not come home, and why?";
  finding.table = {
      "failures",
      "The command repeats the flight, with its picture and its log.",
      {"flight", "end", "cause", "where", "after s", "speed m/s", "waypoints", "command"},
      {}};
  for (const FlightRecord& flight : data.records())
    if (!flight.success())
      finding.table.rows.push_back(
          {data.nameOf(flight), base::choiceName(flight.end), flight.sentence, placeText(flight.at),
           TableCell(flight.time_s, 4), TableCell(flight.speed, 3),
           number(static_cast<std::size_t>(flight.waypoints)), data.commandOf(flight, command)});
  return finding;
}

std::vector<Finding> flightFindings(const FlightData& data, const std::string& command) {
  std::vector<Finding> findings;
  for (const Finding& finding :
       {figuresFinding(data), safetyFinding(data), pathsFinding(data), testsFinding(data),
        claimsFinding(data), failuresFinding(data, command)})
    if (!finding.table.rows.empty()) findings.push_back(finding);
  return findings;
}

Table flightsTable(const FlightData& data) {
  Table table = {"flights",
                 "Every flight.",
                 {"flight", "end", "time_s", "length_m", "clearance_m", "home_offset_m",
                  "max_speed", "waypoints", "unseen", "updates", "bits", "sentence"},
                 {}};
  for (const FlightRecord& r : data.records())
    table.rows.push_back(
        {data.nameOf(r), base::choiceName(r.end), TableCell(r.time_s, 6), TableCell(r.length_m, 6),
         TableCell(r.clearance_m, 4), TableCell(r.home_offset_m, 4), TableCell(r.max_speed, 4),
         number(static_cast<std::size_t>(r.waypoints)), number(static_cast<std::size_t>(r.unseen)),
         number(static_cast<std::size_t>(r.updates)), std::to_string(r.bits), r.sentence});
  return table;
}

}  // namespace grid_path_planner::flights
