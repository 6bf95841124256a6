// The planners that are compared, each with its colour, and what came of it: choice and legend in one.
#pragma once

#include <QTableWidget>
#include <string>
#include <vector>

#include "grid_path_planner/PlanStatistics.h"

namespace grid_path_planner::nodes {

class ComparisonTable : public QTableWidget {
 public:
  explicit ComparisonTable(QWidget* parent = nullptr);

  // The planners that are ticked.
  std::vector<std::string> chosen() const;
  // Takes their places in the rows of their planners; those of others are emptied.
  void show(const std::vector<PlanStatistics>& results);

 private:
  void setText(int row, int column, const std::string& text);
};

}  // namespace grid_path_planner::nodes
