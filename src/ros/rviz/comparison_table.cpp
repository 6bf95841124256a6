#include "ros/rviz/comparison_table.h"

#include <QHeaderView>
#include <QPixmap>
#include <QTextDocument>
#include <algorithm>
#include <set>

#include "grid_path_planner/base/status.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "panel/planner_colours.h"
#include "panel/shown_text.h"

namespace grid_path_planner::nodes {

using panel::Colour;
using panel::colourOf;
using panel::shownNumber;
using panel::shownText;
using planners::plannerNames;

namespace {

enum Column { PLANNER, COST, LENGTH, TIME, COLUMNS };
constexpr int kSwatch = 12;  // pixels
constexpr std::size_t kLongestText = 300;

QIcon swatchOf(const std::string& planner) {
  const Colour colour = colourOf(planner);
  QPixmap pixels(kSwatch, kSwatch);
  pixels.fill(QColor(colour.red, colour.green, colour.blue));
  return {pixels};
}

// Ticked at first: an exact one on the grid, one of any angle, one that repairs, and rectangles.
bool comparedAtFirst(const std::string& planner) {
  static const std::set<std::string> names = {"weighted_jump_point", "lazy_theta_star",
                                              "incremental_a_star", "rectangle_map"};
  return names.count(planner) > 0;
}

// Qt takes a text with tags for HTML, opens the files that it names, and takes its tags away.
QString tipOf(const std::string& text) {
  if (text.empty()) return {};
  return Qt::convertFromPlainText(QString::fromStdString(shownText(text, kLongestText)),
                                  Qt::WhiteSpaceNormal);
}

}  // namespace

ComparisonTable::ComparisonTable(QWidget* parent)
    : QTableWidget(static_cast<int>(plannerNames().size()), COLUMNS, parent) {
  setHorizontalHeaderLabels({"compare", "cost", "m", "ms"});
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(20);
  horizontalHeader()->setSectionResizeMode(PLANNER, QHeaderView::Stretch);
  for (const int column : {COST, LENGTH, TIME}) setColumnWidth(column, 48);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  for (int row = 0; row < rowCount(); ++row) {
    const std::string& name = plannerNames()[static_cast<std::size_t>(row)];
    auto* item = new QTableWidgetItem(swatchOf(name), QString::fromStdString(name));
    item->setCheckState(comparedAtFirst(name) ? Qt::Checked : Qt::Unchecked);
    setItem(row, PLANNER, item);
  }
}

std::vector<std::string> ComparisonTable::chosen() const {
  std::vector<std::string> names;
  for (int row = 0; row < rowCount(); ++row)
    if (item(row, PLANNER)->checkState() == Qt::Checked)
      names.push_back(plannerNames()[static_cast<std::size_t>(row)]);
  return names;
}

void ComparisonTable::show(const std::vector<PlanStatistics>& results) {
  for (int row = 0; row < rowCount(); ++row) {
    const std::string& name = plannerNames()[static_cast<std::size_t>(row)];
    const auto result =
        std::find_if(results.begin(), results.end(),
                     [&](const PlanStatistics& one) { return one.planner == name; });
    const bool there = result != results.end(),
               found = there && base::statusFromName(result->status) == base::Status::FOUND;
    setText(row, COST,
            found ? shownNumber(result->cost) : shownText(there ? result->status : "", 12));
    setText(row, LENGTH, found ? shownNumber(result->length_m) : "");
    setText(row, TIME, there ? shownNumber(result->planning_time_ms) : "");
    item(row, COST)->setToolTip(tipOf(there ? result->message : ""));
  }
}

void ComparisonTable::setText(int row, int column, const std::string& text) {
  setItem(row, column, new QTableWidgetItem(QString::fromStdString(text)));
}

}  // namespace grid_path_planner::nodes
