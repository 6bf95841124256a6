// The panel `Plan Panel` of rviz: parameters of path_planner, points, plans, comparison, driving.
//
// What it shows and allows is in panel::PanelModel; this class moves messages between that, the nodes
// and the widgets. All of it is in the thread of rviz's window, in which nothing waits: topics come in
// a queue of its own that a timer empties, and services are called in threads of their own with a
// deadline (service_calls.h). Without the nodes, or with nodes that are stopped, rviz goes on.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <rviz/panel.h>
#include <std_srvs/Trigger.h>

#include <QTimer>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/ComparePlans.h"
#include "panel/panel_model.h"
#include "ros/rviz/panel_markers.h"
#include "ros/rviz/panel_nodes.h"
#include "ros/rviz/panel_widgets.h"
#include "ros/rviz/point_handles.h"
#include "ros/rviz/service_calls.h"

namespace grid_path_planner::nodes {

class PlanPanel : public rviz::Panel {
 public:
  explicit PlanPanel(QWidget* parent = nullptr);
  ~PlanPanel() override;

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  using Point = std::function<void(const std::string& frame, const path::Pose&)>;

  void connectButtons();
  void subscribePoints();
  void subscribePoint(const std::string& topic, const Point& point);
  // Somebody has changed the namespace in the field.
  void changeNodes();
  // To the nodes of that namespace, whether the master answers or not.
  void connectNodes();
  void leaveNodes();
  std::string namespaceInField() const;
  bool isConnectedTo(const std::string& name) const;
  void connectPlans();
  void connectDrives();
  void tick();
  void draw();

  void otherPlan(const PlanStatistics& plan);
  void sendPlan(const panel::PlanRequest& request);
  void compare();
  // `points`: the revision of the model that was asked about.
  void showComparison(const ComparePlans::Response& response, unsigned points);
  void explain();
  void showExplanation(const ExplainPlan::Response& why, unsigned points);
  void setParameter(const dynamic_reconfigure::Config& change);
  void drive();
  // A sentence says what came of it.
  void callDriver(const std::string& service);
  void askDriver(const std::string& service,
                 std::function<void(const std_srvs::Trigger&)> answered);
  void cancelPlans();
  void cancelDrives();
  void cancel();
  void saveWaypoints();
  void loadWaypoints();

  static double now();

  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  panel::PanelModel model_;
  ServiceCalls calls_;
  std::unique_ptr<PanelNodes> nodes_;
  std::map<std::string, unsigned> requests_;  // numbers of the model by the action's id; the last
  std::string drive_;             // the action's id of the panel's own, until its result
  double parameter_sent_ = -1e9;  // s, when it was
  bool parameters_known_ = false;
  ParameterControls* parameters_;
  PanelWidgets widgets_;
  PointHandles handles_;
  ros::Publisher markers_;
  std::vector<ros::Subscriber> points_;
  unsigned drawn_ = 0;  // revision of the model
  std::vector<ComparedPath> compared_;
  visualization_msgs::MarkerArray explanation_;
  QTimer timer_;
};

}  // namespace grid_path_planner::nodes
