#include "study/findings/findings.h"

#include <algorithm>
#include <sstream>

#include "study/findings/finding_text.h"
#include "study/findings/verdicts.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status;
using costmap::CostmapOptions;
using grid::Cell;

namespace {

TableCell cellOf(Cell cell) {
  std::ostringstream out;
  out << cell;
  return out.str();
}

double gapOf(const StudyRun& run) {
  return run.optimum > 0.0 ? run.cost / run.optimum - 1.0 : 0.0;
}

std::vector<TableCell> rowOf(const StudyData& data, const StudyRun& run) {
  const StudySetting& setting = data.settingOf(run);
  std::vector<TableCell> row = {data.study().maps[setting.map].name,
                                TableCell(setting.costmap.kernel, 3),
                                choiceName(setting.costmap.kernel_rule),
                                choiceName(setting.border),
                                setting.weights,
                                data.study().variants[run.variant].label,
                                cellOf(run.start),
                                cellOf(run.goal),
                                std::string(toString(run.status))};
  const bool found = run.status == Status::FOUND;
  const auto add = [&row, found](double value) {
    row.push_back(found ? TableCell(value, 6) : TableCell("–"));
  };
  add(run.cost);
  add(gapOf(run));
  add(run.length_m);
  add(static_cast<double>(run.cells));
  add(static_cast<double>(run.border_cells));
  add(run.turning_rad);
  add(run.clearance_m);
  add(run.unknown_m);
  add(run.occupied_m);
  row.emplace_back(static_cast<double>(run.expanded), 6);
  row.emplace_back(static_cast<double>(run.generated), 6);
  row.emplace_back(static_cast<double>(run.bytes), 6);
  row.emplace_back(run.preparation_ms, 4);
  row.emplace_back(medianTime(run), 4);
  row.emplace_back(*std::min_element(run.times_ms.begin(), run.times_ms.end()), 4);
  row.emplace_back(*std::max_element(run.times_ms.begin(), run.times_ms.end()), 4);
  row.emplace_back(run.note);
  return row;
}

bool several(const std::vector<StudySetting>& settings, int CostmapOptions::*option) {
  return std::any_of(settings.begin(), settings.end(), [&](const StudySetting& setting) {
    return setting.costmap.*option != settings.front().costmap.*option;
  });
}

}  // namespace

std::vector<Finding> findingsOf(const StudyData& data) {
  std::vector<Finding> findings;
  const auto add = [&findings](const Finding& finding) {
    if (!finding.table.rows.empty()) findings.push_back(finding);
  };
  add(verdictsFinding(data));
  findings.push_back(timeFinding(data));
  if (several(data.study().settings, &CostmapOptions::kernel)) add(kernelFinding(data));
  add(preparationFinding(data));
  findings.push_back(effortFinding(data));
  findings.push_back(optimalFinding(data));
  add(shortestFinding(data));
  add(countsFinding(data));
  add(cellsFinding(data));
  add(otherCellsFinding(data));
  findings.push_back(weightsFinding(data));
  add(mapsFinding(data));
  return findings;
}

Table runsTable(const StudyData& data) {
  Table table;
  table.name = "runs";
  table.caption = "Every run. Times are of planning alone.";
  table.columns = {"map",
                   "kernel",
                   "rule",
                   "border",
                   "weights",
                   "variant",
                   "start",
                   "goal",
                   "status",
                   "cost",
                   "gap",
                   "length [m]",
                   "cells of the path",
                   "in unfilled blocks",
                   "turning [rad]",
                   "clearance [m]",
                   "unknown [m]",
                   "occupied [m]",
                   "expanded",
                   "generated",
                   "bytes",
                   "preparation [ms]",
                   "time [ms]",
                   "fastest [ms]",
                   "slowest [ms]",
                   "note"};
  for (const StudyRun& run : data.runs()) table.rows.push_back(rowOf(data, run));
  return table;
}

}  // namespace grid_path_planner::study
