// The panel's widgets and where they are; what they do is given by PlanPanel.
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include "panel/panel_model.h"
#include "ros/rviz/comparison_table.h"
#include "ros/rviz/parameter_controls.h"

namespace grid_path_planner::nodes {

// What the model says of the plan and the drive.
class PanelReport {
 public:
  PanelReport();
  void addTo(QVBoxLayout* column) const;
  void show(const panel::PanelModel& model);

 private:
  QLabel *sentence_, *figures_, *driving_;
  QProgressBar* progress_;
};

struct PanelWidgets {
  // All belong to `parent`.
  PanelWidgets(QWidget* parent, ParameterControls* parameters);

  // What the model says, and which buttons may be pressed.
  void show(const panel::PanelModel& model);

  QLineEdit* name_space;
  QLabel* nodes;
  QPushButton *start_at_vehicle, *remove_via, *clear;
  QCheckBox* best_order;
  QPushButton *plan, *compare, *explain;
  QPushButton *drive, *pause, *resume, *cancel;
  QPushButton *save, *load;
  PanelReport report;
  ComparisonTable* comparison;
};

}  // namespace grid_path_planner::nodes
