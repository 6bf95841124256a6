#include "trials/report/trial_findings.h"

#include <cmath>
#include <map>

#include "trials/report/trial_cells.h"

namespace grid_path_planner::trials {

using study::Finding, study::shownNumber, study::Table, study::TableCell;

namespace {

using Row = std::vector<TableCell>;

double markersMetres(const RowResult& row) {
  return row.markers.metres;
}
double markersDegrees(const RowResult& row) {
  return row.markers.degrees;
}
double viewMetres(const RowResult& row) {
  return row.in_view.metres;
}
double viewDegrees(const RowResult& row) {
  return row.in_view.degrees;
}

TableCell cellOf(const MeanAndSpread& figure) {
  return withSpread(figure.mean, figure.deviation);
}

// Of each run, over time, and its mean spread in time: what was published is one run.
TableCell overTime(const TrialData& data, std::size_t set, std::size_t row,
                   double (*figure)(const RowResult&), double (*spread)(const RowResult&)) {
  return withSpread(data.mean(set, row, figure).mean, data.mean(set, row, spread).mean);
}

double publishedFigure(const TrialData& data, const std::string& name) {
  const auto figure = data.study.published_figures.find(name);
  return figure == data.study.published_figures.end() ? NAN : figure->second;
}

Row figuresRow(const TrialData& data, std::size_t set, std::size_t number) {
  const TrialRow& row = trialRows()[number];
  Row cells = {data.study.sets[set].name, row.name, row.inputs};
  Row published = publishedCells(data.study, row.name);
  if (row.name == "L1" &&
      published[0].text.empty()) {  // no more was published than what it stays below
    published[0] = TableCell(publishedFigure(data, "L1 metres"), 2);
    published[1] = TableCell(publishedFigure(data, "L1 degrees"), 2);
  }
  cells.insert(cells.end(), published.begin(), published.end());
  cells.push_back(overTime(data, set, number, markersMetres,
                           [](const RowResult& r) { return r.markers.metres_deviation; }));
  cells.push_back(overTime(data, set, number, markersDegrees,
                           [](const RowResult& r) { return r.markers.degrees_deviation; }));
  cells.push_back(cellOf(data.mean(set, number, [](const auto& r) { return r.smoothness; })));
  cells.push_back(cellOf(data.mean(set, number, viewMetres)));
  cells.push_back(cellOf(data.mean(set, number, viewDegrees)));
  cells.push_back(cellOf(data.mean(set, number, [](const auto& r) { return r.all.metres; })));
  cells.push_back(TableCell(data.shown(set, number).markers.metres, 3));
  cells.push_back(TableCell(data.shown(set, number).in_view.metres, 3));
  return cells;
}

const char* nameOf(Water water) {
  return water == Water::TURBID ? "E*" : "E0";
}

const char* nameOf(PanelMethod method) {
  return method == PanelMethod::MEAN         ? "mean over markers"
         : method == PanelMethod::SEQUENTIAL ? "mean, sequential slerp"
                                             : "joint";
}

TableCell rpeCell(const TrialData& data, std::size_t set, std::size_t row, std::size_t length) {
  std::vector<double> metres, degrees;
  for (const RunRecord& run : data.runs)
    if (run.set == set && run.seed != kShownSeed)
      if (const auto& error = run.rows[row].rpe[length]) {
        metres.push_back(error->metres);
        degrees.push_back(error->degrees);
      }
  if (metres.empty()) return "–";
  TableCell cell(meanOf(metres).mean, 3);
  cell.text += " m, " + shownNumber(meanOf(degrees).mean, 3) + "°";
  return cell;
}

TableCell nisCell(const TrialData& data, std::size_t set, std::size_t row, std::size_t source) {
  double sum = 0.0, count = 0.0;
  for (const RunRecord& run : data.runs)
    if (run.set == set && run.seed != kShownSeed) {
      const NisMean& nis = run.rows[row].nis[source];
      sum += nis.mean * nis.count;
      count += nis.count;
    }
  if (count == 0.0) return "–";
  return TableCell(sum / count, 3);
}

template <class MakeRow>
void addRows(const TrialData& data, const MakeRow& make, Table& table) {
  for (std::size_t set = 0; set < data.study.sets.size(); ++set)
    for (std::size_t row = 0; row < trialRows().size(); ++row)
      table.rows.push_back(make(data, set, row));
}

}  // namespace

ErrorSpread panelError(const TrialData& data, std::size_t set, Water water, PanelMethod method) {
  std::vector<double> metres, degrees;
  for (const SeenFrame& frame : data.frames) {
    const ViewSolution& solution = frame.solutions[set];
    if (frame.water != water || !solution.mean) continue;
    const PanelErrors& panel = solution.panel;
    if (method == PanelMethod::JOINT && !panel.joint) continue;
    const PoseError& error = method == PanelMethod::MEAN         ? panel.mean
                             : method == PanelMethod::SEQUENTIAL ? panel.sequential
                                                                 : *panel.joint;
    metres.push_back(error.metres);
    degrees.push_back(error.degrees);
  }
  const MeanAndSpread m = meanOf(metres), d = meanOf(degrees);
  return {m.mean, m.deviation, d.mean, d.deviation, static_cast<int>(metres.size())};
}

Finding figuresFinding(const TrialData& data) {
  Finding finding{
      "How far is the filter off, against the markers and against the truth?",
      {"figures",
       "Published: against the markers' pose, ± over time, one recording (L1: simulated, less "
       "than). Ours: means over the "
       "seeds; against the "
       "markers ± over time, m_A and against the truth ± between seeds. Against markers, and the "
       "truth beside it, "
       "while they are in view. Last: the one run with the poses of the images themselves.",
       {"errors", "row", "inputs", "published m", "published °", "published m_A",
        "against markers m", "against markers °", "m_A", "against truth m", "against truth °",
        "truth, all times m", "images: markers m", "images: truth m"},
       {}},
      {}};
  addRows(data, figuresRow, finding.table);
  for (std::size_t set = 0; set < data.study.sets.size(); ++set) {
    std::string answer = data.study.sets[set].name + ", against markers (truth):";
    for (const char* name : {"L1", "L2", "L3", "L4", "L5", "L5 joint"}) {
      const std::size_t row = rowNumber(name);
      answer += std::string(" ") + name + " " +
                shownNumber(data.mean(set, row, markersMetres).mean, 2) + " m, " +
                shownNumber(data.mean(set, row, markersDegrees).mean, 2) + "° (" +
                shownNumber(data.mean(set, row, viewMetres).mean, 2) + " m, " +
                shownNumber(data.mean(set, row, viewDegrees).mean, 2) + "°);";
    }
    answer.back() = '.';
    finding.answers.push_back(answer);
  }
  return finding;
}

Finding panelFinding(const TrialData& data) {
  Finding finding{"How far is the panel's pose off in rendered images, T_P?",
                  {"panel",
                   "Of every image of the drive in which the method has a pose, ± over images; the "
                   "vehicle's pose is "
                   "known. E0: clear water, E*: turbid.",
                   {"errors", "water", "method", "images", "m", "°", "published m", "published °"},
                   {}},
                  {}};
  for (std::size_t set = 0; set < data.study.sets.size(); ++set)
    for (const Water water : {Water::CLEAR, Water::TURBID})
      for (const PanelMethod method :
           {PanelMethod::MEAN, PanelMethod::SEQUENTIAL, PanelMethod::JOINT}) {
        const ErrorSpread error = panelError(data, set, water, method);
        const bool published = water == Water::TURBID && method != PanelMethod::JOINT;
        finding.table.rows.push_back(
            {data.study.sets[set].name, nameOf(water), nameOf(method), TableCell(error.count, 6),
             withSpread(error.metres, error.metres_deviation),
             withSpread(error.degrees, error.degrees_deviation),
             published ? TableCell(publishedFigure(data, "panel metres"), 3) : TableCell(""),
             published ? TableCell(publishedFigure(data, "panel degrees"), 3) : TableCell("")});
      }
  const ErrorSpread mean = panelError(data, 0, Water::TURBID, PanelMethod::MEAN);
  const ErrorSpread joint = panelError(data, 0, Water::TURBID, PanelMethod::JOINT);
  finding.answers.push_back("In turbid water the mean over markers is off by " +
                            shownNumber(mean.metres, 3) + " m and " + shownNumber(mean.degrees, 3) +
                            "°, the joint pose by " + shownNumber(joint.metres, 3) + " m and " +
                            shownNumber(joint.degrees, 3) + "°.");
  return finding;
}

Finding consistencyFinding(const TrialData& data) {
  Finding finding{"Are the errors as large as the filter says?",
                  {"consistency",
                   "NEES: mean over runs and seconds; inside: share of seconds in which the mean "
                   "over the runs is "
                   "within its 95 % bounds. NIS: mean of what was taken of each source, which "
                   "is 3 of DVL and USBL, 1 of depth and 6 of "
                   "markers where covariances are right.",
                   {"errors", "row", "NEES of 15", "inside", "NEES of the pose's 6", "inside",
                    "NIS DVL", "NIS depth", "NIS USBL", "NIS markers", "fixes gated", "resets"},
                   {}},
                  {}};
  addRows(
      data,
      [](const TrialData& of, std::size_t set, std::size_t row) {
        const Consistency c = consistencyOf(of, set, row);
        Row cells = {of.study.sets[set].name,   trialRows()[row].name,
                     TableCell(c.mean, 3),      TableCell(c.inside, 2),
                     TableCell(c.pose_mean, 3), TableCell(c.pose_inside, 2)};
        for (std::size_t i = 0; i < kNisSources.size(); ++i)
          cells.push_back(nisCell(of, set, row, i));
        cells.push_back(
            TableCell(of.mean(set, row, [](const auto& r) { return r.gated; }).mean, 3));
        cells.push_back(
            TableCell(of.mean(set, row, [](const auto& r) { return r.resets; }).mean, 3));
        return cells;
      },
      finding.table);
  const Consistency all = consistencyOf(data, 0, rowNumber("all"));
  finding.answers.push_back("With all sensors as modelled NEES is " + shownNumber(all.mean, 3) +
                            " of 15 and " + shownNumber(all.pose_mean, 3) + " of 6, in " +
                            shownNumber(100.0 * all.inside, 3) + " % of seconds inside.");
  return finding;
}

Finding tracksFinding(const TrialData& data) {
  Finding finding{"How far are trajectories off, as evo measures them?",
                  {"tracks",
                   "ATE: root mean square of the distances, not aligned. RPE: root mean squares "
                   "over each 1, 5 and 10 m of "
                   "path. Means over the seeds; the first seed's trajectories are in tum/.",
                   {"errors", "row", "ATE m", "RPE 1 m", "RPE 5 m", "RPE 10 m"},
                   {}},
                  {}};
  addRows(
      data,
      [](const TrialData& of, std::size_t set, std::size_t row) {
        return Row{of.study.sets[set].name,
                   trialRows()[row].name,
                   cellOf(of.mean(set, row, [](const auto& r) { return r.ate; })),
                   rpeCell(of, set, row, 0),
                   rpeCell(of, set, row, 1),
                   rpeCell(of, set, row, 2)};
      },
      finding.table);
  return finding;
}

Finding goalsFinding(const TrialData& data) {
  Finding finding{
      "Which goals are met?",
      {"goals",
       "Means over the seeds, those of NEES with their standard error. A dash: nothing was "
       "seen of it, and the goal is not met.",
       {"goal", "wanted", "found", "standard error", "unit", "met"},
       {}},
      {}};
  std::size_t met = 0;
  const std::vector<Goal> goals = goalsOf(data);
  for (const Goal& goal : goals) {
    met += goal.met;
    finding.table.rows.push_back(
        {goal.name, goal.wanted, TableCell(goal.found, 3),
         goal.standard_error ? TableCell(*goal.standard_error, 2) : TableCell(""), goal.unit,
         goal.met ? "yes" : "no"});
  }
  finding.answers.push_back(std::to_string(met) + " of " + std::to_string(goals.size()) +
                            " are met.");
  return finding;
}

Finding predictionsFinding(const TrialData& data) {
  Finding finding{
      "What of that was predicted?",
      {"predictions",
       "A limit is confirmed where it holds in 95 % of the runs that have its figures, refuted "
       "where it holds in 5 % or "
       "less; which of two is larger, where more runs say so than by chance (two standard errors "
       "from a half), or fewer; undecided where nothing was seen.",
       {"prediction", "verdict", "figures"},
       {}},
      {""}};
  std::map<PredictionVerdict, int> counts;
  for (const Prediction& prediction : predictionsOf(data)) {
    ++counts[prediction.verdict];
    finding.table.rows.push_back(
        {prediction.claim, textOf(prediction.verdict), prediction.figures});
    finding.answers.push_back(std::string(textOf(prediction.verdict)) + ": " + prediction.claim +
                              ": " + prediction.figures);
  }
  for (const auto& [verdict, count] : counts)
    finding.answers.front() += std::string(finding.answers.front().empty() ? "" : ", ") +
                               std::to_string(count) + " " + textOf(verdict);
  return finding;
}

std::vector<Finding> trialFindings(const TrialData& data) {
  return {figuresFinding(data), panelFinding(data), consistencyFinding(data),
          tracksFinding(data),  goalsFinding(data), predictionsFinding(data)};
}

}  // namespace grid_path_planner::trials
