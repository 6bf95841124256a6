#include "trials/report/trial_report.h"

#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/files.h"
#include "study/report/markdown.h"
#include "study/report/markup.h"
#include "study/report/report_page.h"
#include "study/report/svg_chart.h"
#include "trials/report/trial_findings.h"

namespace grid_path_planner::trials {

using base::writeFileAtomically;
using study::BoxGroup, study::Finding, study::ReportPage, study::StudyTarget;

namespace {

// Of each published row: against the markers and against the truth, for every error set.
std::vector<BoxGroup> boxesIn(const TrialData& data, std::size_t set, double ErrorSpread::*figure) {
  std::vector<BoxGroup> groups;
  for (const char* name : {"L1", "L2", "L3", "L4", "L5", "L5 joint", "L5 USBL"}) {
    const std::size_t row = rowNumber(name);
    groups.push_back(
        {name,
         {{"against markers",
           data.figures(set, row, [&](const RowResult& r) { return r.markers.*figure; })},
          {"against truth",
           data.figures(set, row, [&](const RowResult& r) { return r.in_view.*figure; })}}});
  }
  return groups;
}

std::string chartsFor(const TrialData& data, const Finding& finding, const std::string& command) {
  if (finding.table.name != "figures") return "";
  std::string html;
  for (std::size_t set = 0; set < data.study.sets.size(); ++set) {
    const std::string name = data.study.sets[set].name;
    html += study::figureHtml(
        study::boxPlot("Distance, errors " + name, "m", boxesIn(data, set, &ErrorSpread::metres)),
        "Means over time of each seed, while markers are in view. Made by", command);
    html += study::figureHtml(
        study::boxPlot("Angle, errors " + name, "°", boxesIn(data, set, &ErrorSpread::degrees)),
        "Made by", command);
  }
  return html;
}

std::string notDoneHtml(std::size_t missing) {
  if (missing == 0) return "";
  return "<section class=\"failure\"><h2>Not done</h2><p><b>" + std::to_string(missing) +
         "</b> units of work are missing; the same command does them.</p></section>";
}

std::string pageOf(const TrialData& data, const std::vector<Finding>& findings,
                   const StudyTarget& target) {
  std::string origin;
  if (!data.study.published_source.empty())
    origin = "<br>Published figures: " + study::escaped(data.study.published_source);
  ReportPage page{data.study.title,
                  target.command,
                  origin,
                  "<ul class=\"facts\">" + study::fact(data.runs.size(), "run") +
                      study::fact(data.frames.size(), "image") +
                      study::fact(data.study.sets.size(), "error set") + "</ul>" +
                      firstAnswersHtml(findings),
                  {},
                  notDoneHtml(data.missing)};
  for (const Finding& finding : findings) {
    page.links.push_back(linkTo(finding));
    page.main += findingHtml(finding, chartsFor(data, finding, target.command));
  }
  return pageHtml(page, "{\"pictures\": []}");
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) out += letter == '\'' ? std::string("''") : std::string(1, letter);
  return out + "'";
}

std::string yamlNumber(double number) {
  if (std::isnan(number)) return ".nan";
  if (std::isinf(number)) return number > 0.0 ? ".inf" : "-.inf";
  return base::decimalText(number);
}

// In YAML.
std::string summaryOf(const TrialData& data) {
  std::string text = "missing: " + std::to_string(data.missing) + "\ngoals:\n";
  for (const Goal& goal : goalsOf(data))
    text += "  - {goal: " + quoted(goal.name) + ", wanted: " + quoted(goal.wanted) +
            ", found: " + yamlNumber(goal.found) +
            (goal.standard_error ? ", standard_error: " + yamlNumber(*goal.standard_error) : "") +
            ", unit: " + quoted(goal.unit) + ", met: " + (goal.met ? "true" : "false") + "}\n";
  text += "predictions:\n";
  for (const Prediction& prediction : predictionsOf(data))
    text += "  - {claim: " + quoted(prediction.claim) + ", verdict: " + textOf(prediction.verdict) +
            ", figures: " + quoted(prediction.figures) + "}\n";
  return text;
}

std::string resultsPage(const std::vector<Finding>& findings, const TrialData& data,
                        const StudyTarget& target) {
  std::string page = "# Results: " + study::markdown(data.study.title) + "\n\nRuns of commit " +
                     (target.commit.empty() ? "(not told)" : study::markdown(target.commit)) +
                     ", by\n\n" + study::markdownCode(target.command) +
                     "\n\nDo not edit: the command writes it anew.\n";
  for (const Finding& finding : findings) page += markdownSection(finding);
  return page;
}

}  // namespace

void writeTrialReport(const TrialData& data, const StudyTarget& target) {
  const std::vector<Finding> findings = trialFindings(data);
  for (const Finding& finding : findings)
    writeFileAtomically(target.folder + '/' + finding.table.name + ".csv", csvOf(finding.table));
  writeFileAtomically(target.folder + "/summary.yaml", summaryOf(data));
  writeFileAtomically(target.folder + "/report.html", pageOf(data, findings, target));
  if (!target.results.empty() && data.missing == 0)
    writeFileAtomically(target.results, resultsPage(findings, data, target));
}

}  // namespace grid_path_planner::trials
