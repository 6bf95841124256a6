// Text of other nodes in the panel.
#include <gtest/gtest.h>

#include <QTextDocument>
#include <QTextDocumentFragment>
#include <string>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "ros/rviz/comparison_table.h"
#include "ros/rviz/panel_window.h"

namespace grid_path_planner::nodes {
namespace {

PlanStatistics refusalBy(const std::string& planner, const std::string& message) {
  PlanStatistics statistics;
  statistics.planner = planner;
  statistics.status = "INVALID_REQUEST";
  statistics.message = message;
  return statistics;
}

// Qt takes a tip for HTML where it looks like that, and opened the files that a sentence named.
TEST(PanelTexts, TagsOfASentenceAreShownAndNotObeyed) {
  test::beginApplication();
  ComparisonTable table;
  const std::string message = "<b>no</b> & <img src=\"file:///etc/hostname\">";
  table.show({refusalBy(planners::plannerNames()[0], message)});
  const QString tip = table.item(0, 1)->toolTip();
  EXPECT_FALSE(tip.contains("<img")) << tip.toStdString();
  ASSERT_TRUE(Qt::mightBeRichText(tip)) << "so that what is escaped is shown as it was";
  EXPECT_EQ(QTextDocumentFragment::fromHtml(tip).toPlainText().toStdString(), message);
  table.show({});
  EXPECT_TRUE(table.item(0, 1)->toolTip().isEmpty());
}

}  // namespace
}  // namespace grid_path_planner::nodes
