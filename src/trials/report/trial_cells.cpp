#include "trials/report/trial_cells.h"

namespace grid_path_planner::trials {

using study::TableCell;

TableCell withSpread(double value, double spread) {
  TableCell cell(value, 3);
  if (cell.number) cell.text += " ± " + study::shownNumber(spread, 2);
  return cell;
}

std::vector<TableCell> publishedCells(const TrialSettings& trial, const std::string& row) {
  const auto published = trial.published.find(row);
  if (published == trial.published.end()) return {"", "", ""};
  const PublishedRow& p = published->second;
  return {withSpread(p.metres, p.metres_spread), withSpread(p.degrees, p.degrees_spread),
          TableCell(p.smoothness, 2)};
}

}  // namespace grid_path_planner::trials
