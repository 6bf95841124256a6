#include "trials/report/recorded_report.h"

#include <array>

#include "grid_path_planner/base/files.h"
#include "localization/chi_squared.h"
#include "study/report/markdown.h"
#include "study/report/markup.h"
#include "study/report/report_page.h"
#include "trials/report/trial_cells.h"

namespace grid_path_planner::trials {

using base::writeFileAtomically;
using localization::HeardInput, localization::Source;
using study::Finding, study::shownNumber, study::TableCell;

namespace {

using Row = std::vector<TableCell>;

constexpr std::array<int, kNisSources.size()> kDegreesOfFreedom = {3, 1, 3, 6};

TableCell countCell(std::size_t count) {
  return {static_cast<double>(count), 12};
}

void addInput(const HeardInput& input, Finding& finding) {
  finding.table.rows.push_back({input.topic, countCell(input.heard), countCell(input.used()),
                                countCell(input.refused), input.reason});
}

Finding inputsFinding(const RecordedResults& results) {
  Finding finding{"What is in the bag?",
                  {"inputs",
                   "Messages of each topic; refused: as vehicle_localizer refuses them, with the "
                   "reason of the last.",
                   {"topic", "messages", "used", "refused", "why"},
                   {}},
                  {}};
  for (const auto& input : results.recording.inputs) addInput(input.second, finding);
  addInput(results.recording.truth_input, finding);
  std::string missing;
  for (const RecordedRow& row : results.rows)
    if (!row.missing.empty()) missing += (missing.empty() ? "" : ", ") + row.row.name;
  finding.answers.push_back(missing.empty() ? "It allows every row."
                                            : "It does not allow the rows " + missing + ".");
  for (const RecordedRow& row : results.rows)
    if (!row.missing.empty()) finding.answers.push_back(row.row.name + ": " + row.missing + ".");
  return finding;
}

void addSpread(const ErrorSpread& spread, Row& cells) {
  cells.push_back(withSpread(spread.metres, spread.metres_deviation));
  cells.push_back(withSpread(spread.degrees, spread.degrees_deviation));
}

// Calls `use` with each row that was played, and its result, in the order of the table.
template <class Use>
void forEachPlayed(const RecordedResults& results, const Use& use) {
  for (const RecordedRow& row : results.rows)
    if (const auto played = results.played.find(row.row.name); played != results.played.end())
      use(row.row, played->second);
}

Finding figuresFinding(const RecordedResults& results) {
  Finding finding{
      "How far is the filter off, against the markers and against the truth?",
      {"figures",
       "± over time. Published: against the markers' pose. Against markers, and the truth beside "
       "it, at the stamps of their poses. m_A: of all poses, at their rate.",
       {"row", "inputs", "published m", "published °", "published m_A", "against markers m",
        "against markers °", "m_A", "against truth m", "against truth °", "truth, all times m",
        "truth, all times °"},
       {}},
      {}};
  std::string answer;
  forEachPlayed(results, [&](const TrialRow& row, const RowResult& result) {
    Row cells = {row.name, row.inputs};
    for (const TableCell& cell : publishedCells(results.trial, row.name)) cells.push_back(cell);
    addSpread(result.markers, cells);
    cells.push_back(TableCell(result.smoothness, 2));
    addSpread(result.in_view, cells);
    addSpread(result.all, cells);
    finding.table.rows.push_back(cells);
    if (result.markers.count == 0 && result.all.count == 0) return;
    const ErrorSpread& error = result.markers.count > 0 ? result.markers : result.all;
    answer += (answer.empty() ? "" : "; ") + row.name + ": " + shownNumber(error.metres, 2) +
              " m, " + shownNumber(error.degrees, 2) + "°";
  });
  finding.answers.push_back(answer.empty()
                                ? "There is neither a marker pose nor a truth to compare with."
                                : "Against markers, or the truth without: " + answer + ".");
  return finding;
}

// "2.9 of 3 (2.7 to 3.3)"
TableCell nisCell(const NisMean& nis, int degrees_of_freedom) {
  if (nis.count == 0) return "–";
  const auto bounds = localization::meanBounds(degrees_of_freedom, nis.count, 0.95);
  TableCell cell(nis.mean, 3);
  cell.text += " of " + std::to_string(degrees_of_freedom) + " (" + shownNumber(bounds.low, 3) +
               " to " + shownNumber(bounds.high, 3) + ")";
  return cell;
}

// Of the last row, which has most inputs.
std::string overconfidentInputs(const RowResult& result) {
  std::string names;
  for (std::size_t i = 0; i < kNisSources.size(); ++i)
    if (const NisMean& nis = result.nis[i]; nis.count > 0)
      if (nis.mean > localization::meanBounds(kDegreesOfFreedom[i], nis.count, 0.95).high)
        names += (names.empty() ? "" : ", ") + std::string(nameOf(kNisSources[i]));
  return names;
}

Finding consistencyFinding(const RecordedResults& results) {
  Finding finding{"Are the errors as large as covariances say?",
                  {"consistency",
                   "NIS: mean of what was taken of each input, and in brackets what holds 95 % of "
                   "such means where covariances are right; above: its errors are larger than its "
                   "covariance says. NEES: of the pose's 6, where there is a truth.",
                   {"row", "NIS DVL", "NIS depth", "NIS USBL", "NIS markers",
                    "NEES of the pose's 6", "fixes gated", "resets"},
                   {}},
                  {}};
  std::string answer;
  forEachPlayed(results, [&](const TrialRow& row, const RowResult& result) {
    Row cells = {row.name};
    for (std::size_t i = 0; i < kNisSources.size(); ++i)
      cells.push_back(nisCell(result.nis[i], kDegreesOfFreedom[i]));
    double sum = 0.0;
    for (const double nees : result.pose_nees) sum += nees;
    cells.push_back(result.pose_nees.empty()
                        ? TableCell("–")
                        : TableCell(sum / static_cast<double>(result.pose_nees.size()), 3));
    cells.push_back(countCell(static_cast<std::size_t>(result.gated)));
    cells.push_back(countCell(static_cast<std::size_t>(result.resets)));
    finding.table.rows.push_back(cells);
    const std::string names = overconfidentInputs(result);
    answer = row.name + (names.empty() ? ": no input errs more than it says."
                                       : ": these err more than they say: " + names + ".");
  });
  finding.answers.push_back(answer);
  return finding;
}

Finding tracksFinding(const RecordedResults& results) {
  Finding finding{"How far are trajectories off, as evo measures them?",
                  {"tracks",
                   "ATE: root mean square of the distances, not aligned. RPE: root mean squares "
                   "over each 1, 5 and 10 m of path. Trajectories are in tum/.",
                   {"row", "ATE m", "RPE 1 m", "RPE 5 m", "RPE 10 m"},
                   {}},
                  {}};
  forEachPlayed(results, [&](const TrialRow& row, const RowResult& result) {
    Row cells = {row.name, TableCell(result.ate, 3)};
    for (const auto& error : result.rpe)
      cells.push_back(error ? TableCell(shownNumber(error->metres, 3) + " m, " +
                                        shownNumber(error->degrees, 3) + "°")
                            : TableCell("–"));
    finding.table.rows.push_back(cells);
  });
  finding.answers.push_back("Of " + std::to_string(results.recording.truth.size()) +
                            " true poses in the bag.");
  return finding;
}

std::string pageOf(const RecordedResults& results, const std::vector<Finding>& findings,
                   const study::StudyTarget& target) {
  std::string origin = "<br>Bag: " + study::escaped(results.trial.bag);
  if (!results.trial.published_source.empty())
    origin += "<br>Published figures: " + study::escaped(results.trial.published_source);
  study::ReportPage page{results.trial.title,
                         target.command,
                         origin,
                         "<ul class=\"facts\">" + study::fact(results.played.size(), "row") +
                             study::fact(results.recording.measurements.size(), "measurement") +
                             "</ul>" + firstAnswersHtml(findings),
                         {},
                         ""};
  for (const Finding& finding : findings) {
    page.links.push_back(linkTo(finding));
    page.main += findingHtml(finding, "");
  }
  return pageHtml(page, "{\"pictures\": []}");
}

}  // namespace

void writeRecordedReport(const RecordedResults& results, const study::StudyTarget& target) {
  std::vector<Finding> findings = {figuresFinding(results), inputsFinding(results),
                                   consistencyFinding(results)};
  if (!results.recording.truth.empty()) findings.push_back(tracksFinding(results));
  std::string markdown = "# Results: " + study::markdown(results.trial.title) + "\n\nBy\n\n" +
                         study::markdownCode(target.command) +
                         "\n\nDo not edit: the command writes it anew.\n";
  for (const Finding& finding : findings) {
    writeFileAtomically(target.folder + '/' + finding.table.name + ".csv", csvOf(finding.table));
    markdown += markdownSection(finding);
  }
  writeFileAtomically(target.folder + "/report.html", pageOf(results, findings, target));
  if (!target.results.empty()) writeFileAtomically(target.results, markdown);
}

}  // namespace grid_path_planner::trials
