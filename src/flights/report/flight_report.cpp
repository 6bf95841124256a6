#include "flights/report/flight_report.h"

#include "flights/report/flight_findings.h"
#include "flights/report/flight_pictures.h"
#include "grid_path_planner/base/files.h"
#include "study/report/markdown.h"
#include "study/report/markup.h"
#include "study/report/report_page.h"
#include "study/report/svg_chart.h"
#include "study/run_folder.h"

namespace grid_path_planner::flights {

using base::writeFileAtomically;
using study::escaped, study::figureHtml, study::Finding, study::ReportPage, study::shownNumber,
    study::StudyFailure, study::StudyTarget;

namespace {

constexpr std::size_t kDrawnWorlds = 3;  // of a variant
constexpr std::size_t kDrawnEnds = 60;   // of failed flights
constexpr std::size_t kShownFlights = 2000;

std::vector<study::BoxGroup> boxesOf(const FlightData& data,
                                     const std::function<double(const FlightRecord&)>& value) {
  std::vector<study::BoxGroup> groups;
  for (std::size_t i = 0; i < data.study().variants.size(); ++i) {
    const FlightVariant& variant = data.study().variants[i];
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const study::BoxGroup& each) {
      return each.label == variant.name;
    });
    if (group != groups.end()) continue;
    study::BoxGroup made{variant.name, {}};
    for (const std::string& rules : data.rules()) {
      const auto of = data.variantOf(variant.name, rules);
      made.series.push_back({rules, of ? data.values(*of, value) : std::vector<double>()});
    }
    groups.push_back(made);
  }
  return groups;
}

std::string chartsOf(const FlightData& data, const Finding& finding, const std::string& command) {
  if (finding.table.name != "figures") return "";
  return figureHtml(
             study::boxPlot("Time of the flights that came home", "s", boxesOf(data, timeOf)),
             "Box: quartiles and median; whiskers: extremes. Made by", command) +
         figureHtml(
             study::boxPlot("Length of the flights that came home", "m", boxesOf(data, lengthOf)),
             "Made by", command);
}

// A picture of each variant on each of its first worlds, also written as a file.
std::string aboveHtml(const FlightData& data, WorldOutlines& outlines, const StudyTarget& target) {
  std::string html;
  for (std::size_t i = 0; i < data.study().variants.size(); ++i)
    for (std::size_t world = 0; world < std::min(kDrawnWorlds, data.study().worlds.size());
         ++world) {
      std::vector<const FlightRecord*> flights;
      for (const FlightRecord* flight : data.of(i))
        if (flight->world == world) flights.push_back(flight);
      if (flights.empty()) continue;
      const std::string title = pictureTitle(data.study().variants[i], data.study().worlds[world]);
      const std::string svg = flightsPicture(data.study(), outlines.of(world), flights, title);
      writeFileAtomically(target.folder + "/above_" + study::fileNameOf(title) + ".svg",
                          standalonePicture(svg));
      html += figureHtml(svg, title + ", " + std::to_string(flights.size()) + " flights. Made by",
                         target.command);
    }
  return html;
}

std::string endsHtml(const FlightData& data, WorldOutlines& outlines, const std::string& command) {
  std::string html;
  std::size_t drawn = 0;
  for (const FlightRecord& flight : data.records()) {
    if (flight.success() || drawn == kDrawnEnds) continue;
    ++drawn;
    const std::string title =
        data.nameOf(flight) + ", " + base::choiceName(flight.end) + ": " + flight.sentence;
    html += figureHtml(endPicture(data.study(), outlines.of(flight.world), flight, title), title,
                       data.commandOf(flight, command));
  }
  if (html.empty()) return "";
  return "<details><summary>" + std::to_string(drawn) +
         " ends from above, 8 m around each</summary>" + html + "</details>";
}

std::string notFlownHtml(const std::vector<StudyFailure>& failures, std::size_t missing) {
  if (missing == 0) return "";
  std::string html = "<section class=\"failure\"><h2>Not flown</h2><p><b>" +
                     std::to_string(missing) +
                     "</b> flights are missing; the same command flies them.</p><ul>";
  for (const StudyFailure& failure : failures)
    html += "<li>" + escaped(failure.unit) + ": " + escaped(failure.reason) + "</li>";
  return html + "</ul></section>";
}

study::Table shownFlights(const FlightData& data) {
  study::Table table = flightsTable(data);
  if (table.rows.size() <= kShownFlights) return table;
  table.caption += " The first " + std::to_string(kShownFlights) + "; flights.csv has them all.";
  table.rows.erase(table.rows.begin() + kShownFlights, table.rows.end());
  return table;
}

std::string summaryOf(const FlightData& data, const std::vector<Finding>& findings) {
  return "<ul class=\"facts\">" + study::fact(data.records().size(), "flight") +
         study::fact(data.study().variants.size(), "variant") +
         study::fact(data.study().worlds.size(), "world") + "</ul>" + firstAnswersHtml(findings);
}

std::string reportOf(const FlightData& data, const std::vector<Finding>& findings,
                     const std::vector<StudyFailure>& failures, std::size_t missing,
                     const StudyTarget& target) {
  WorldOutlines outlines(data.study());
  std::string origin;
  if (!data.study().published_source.empty())
    origin = "<br>Published figures: " + escaped(data.study().published_source);
  ReportPage page{data.study().title,
                  target.command,
                  origin,
                  summaryOf(data, findings),
                  {},
                  notFlownHtml(failures, missing)};
  for (const Finding& finding : findings) {
    page.links.push_back(linkTo(finding));
    page.main += findingHtml(
        finding,
        chartsOf(data, finding, target.command) +
            (finding.table.name == "failures" ? endsHtml(data, outlines, target.command) : ""));
  }
  page.links.push_back({"above", "All flights from above"});
  page.main += "<section><h2 id=\"about-above\">All flights from above</h2>" +
               aboveHtml(data, outlines, target) + "</section>";
  page.links.push_back({"flights", "Every flight"});
  page.main += "<section><h2 id=\"about-flights\">Every flight</h2>" +
               tableHtml(shownFlights(data), "wide tall") + "</section>";
  return pageHtml(page, "{\"pictures\": []}");
}

std::string flightResultsPage(const FlightData& data, const std::vector<Finding>& findings,
                              const StudyTarget& target) {
  std::string page = "# Results: " + study::markdown(data.study().title) +
                     "\n\nFlights of commit " +
                     (target.commit.empty() ? "(not told)" : study::markdown(target.commit)) +
                     ", by\n\n" + study::markdownCode(target.command) +
                     "\n\nDo not edit: the command writes it anew. Times of the CPU are " +
                     "of one machine at one time; everything else is the same wherever it runs. " +
                     shownNumber(static_cast<double>(data.records().size()), 9) + " flights.\n";
  for (const Finding& finding : findings) page += markdownSection(finding);
  return page;
}

}  // namespace

const std::vector<Outline>& WorldOutlines::of(std::size_t world) {
  if (outlines_[world].empty())
    outlines_[world] = outlinesOf(
        simulation::readWorld(study_.worlds[world].file, base::ReadLimits::ofProcessorTime()),
        std::max(study_.fence_low, study_.start.z() - 1.0),
        std::min(study_.fence_high, study_.start.z() + 1.0));
  return outlines_[world];
}

void writeFlightReport(const FlightData& data, const std::vector<StudyFailure>& failures,
                       std::size_t missing, const StudyTarget& target) {
  const std::vector<Finding> findings = flightFindings(data, target.command);
  writeFileAtomically(target.folder + "/flights.csv", csvOf(flightsTable(data)));
  for (const Finding& finding : findings)
    writeFileAtomically(target.folder + '/' + finding.table.name + ".csv", csvOf(finding.table));
  writeFileAtomically(target.folder + "/report.html",
                      reportOf(data, findings, failures, missing, target));
  if (!target.results.empty() && missing == 0)
    writeFileAtomically(target.results, flightResultsPage(data, findings, target));
}

}  // namespace grid_path_planner::flights
