#include "ros/rviz/plan_panel.h"

#include <string>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

using base::InputError;
using panel::RoutePoints;
using panel::Tone;
using path::Pose;

namespace {

constexpr int kTick = 50;           // ms
constexpr double kOwnChange = 5.0;  // s, in which a refusal is of a parameter that the panel sent
constexpr double kMasterPatience = 0.5;  // s, for which rviz's window may stand

// "" about a namespace as roscpp has them.
std::string complaintAbout(const std::string& name) {
  if (name.find('~') != std::string::npos) return "A namespace has no ~";
  std::string complaint;
  return ros::names::validate(name, complaint) ? "" : complaint;
}

}  // namespace

PlanPanel::PlanPanel(QWidget* parent)
    : rviz::Panel(parent),
      parameters_(new ParameterControls(
          [this](const dynamic_reconfigure::Config& change) { setParameter(change); })),
      widgets_(this, parameters_),
      handles_("plan_panel/points", [this](RoutePoints::Id id, const std::string& frame,
                                           const Pose& pose) { model_.place(id, frame, pose); }),
      markers_(nh_.advertise<visualization_msgs::MarkerArray>("plan_panel/markers", 1, true)) {
  nh_.setCallbackQueue(&queue_);
  connectButtons();
  subscribePoints();
  connectNodes();
  connect(&timer_, &QTimer::timeout, this, [this] { tick(); });
  timer_.start(kTick);
}

PlanPanel::~PlanPanel() {
  timer_.stop();
}

double PlanPanel::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void PlanPanel::connectButtons() {
  const std::vector<std::pair<QPushButton*, std::function<void()>>> buttons = {
      {widgets_.plan, [this] { model_.plan(); }},
      {widgets_.compare, [this] { compare(); }},
      {widgets_.explain, [this] { explain(); }},
      {widgets_.drive, [this] { drive(); }},
      {widgets_.pause, [this] { callDriver("pause"); }},
      {widgets_.resume, [this] { callDriver("resume"); }},
      {widgets_.cancel, [this] { cancel(); }},
      {widgets_.save, [this] { saveWaypoints(); }},
      {widgets_.load, [this] { loadWaypoints(); }},
      {widgets_.start_at_vehicle, [this] { model_.startAtVehicle(); }},
      {widgets_.remove_via, [this] { model_.removeLastVia(); }},
      {widgets_.clear, [this] { model_.clear(); }}};
  for (const auto& [button, pressed] : buttons)
    connect(button, &QPushButton::clicked, this, pressed);
  connect(widgets_.best_order, &QCheckBox::toggled, this,
          [this](bool best) { model_.setBestOrder(best); });
  connect(widgets_.name_space, &QLineEdit::editingFinished, this, [this] { changeNodes(); });
}

void PlanPanel::subscribePoints() {
  subscribePoint("plan_panel/goal", [this](const std::string& frame, const Pose& pose) {
    model_.place({RoutePoints::Kind::GOAL, 0}, frame, pose);
  });
  subscribePoint("plan_panel/start", [this](const std::string& frame, const Pose& pose) {
    model_.place({RoutePoints::Kind::START, 0}, frame, pose);
  });
  subscribePoint("plan_panel/via_point", [this](const std::string& frame, const Pose& pose) {
    model_.addVia(frame, pose);
  });
}

void PlanPanel::subscribePoint(const std::string& topic, const Point& point) {
  points_.push_back(subscribeChecked<geometry_msgs::PoseStamped>(
      nh_, topic, 10, [this, point](const geometry_msgs::PoseStamped& message) {
        try {
          point(message.header.frame_id, poseFromMessage(message.pose));
        } catch (const InputError& error) {
          model_.say(Tone::BAD, std::string("The point is passed over: ") + error.what());
        }
      }));
}

std::string PlanPanel::namespaceInField() const {
  return widgets_.name_space->text().trimmed().toStdString();
}

bool PlanPanel::isConnectedTo(const std::string& name) const {
  return nodes_ && nodes_->nh().getNamespace() == nh_.resolveName(name);
}

// roscpp asks the master for each topic until it answers, and rviz's window would stand so long.
void PlanPanel::changeNodes() {
  const std::string name = namespaceInField();
  if (complaintAbout(name).empty() && !isConnectedTo(name) &&
      !answersXmlRpc(masterUri(), kMasterPatience)) {
    model_.say(Tone::BAD, "The ROS master does not answer: the nodes are those of " +
                              nodes_->nh().getNamespace() +
                              " as before. Press Enter in the field again when it is back");
    return;
  }
  connectNodes();
  Q_EMIT configChanged();
}

// Whoever looks at another vehicle stops none: drives are not ended.
void PlanPanel::leaveNodes() {
  if (nodes_) cancelPlans();
  drive_.clear();
  model_.leaveDriver();
  model_.clear();
}

void PlanPanel::connectNodes() {
  const std::string name = namespaceInField();
  const std::string complaint = complaintAbout(name);
  if (!complaint.empty()) {
    model_.say(Tone::BAD, complaint);
    return;
  }
  if (isConnectedTo(name)) return;
  leaveNodes();
  parameters_known_ = false;
  ros::NodeHandle nh(nh_, name);
  nh.setCallbackQueue(&queue_);
  nodes_.reset();
  nodes_ = std::make_unique<PanelNodes>(
      nh, PanelNodes::Heard{[this](const dynamic_reconfigure::Config& config) {
                              parameters_->show(config);
                              if (std::exchange(parameters_known_, true)) model_.planAgain();
                            },
                            [this](const std::string& reason) {
                              const bool own = now() - parameter_sent_ < kOwnChange;
                              if (own && !reason.empty())
                                model_.say(Tone::BAD, "Refused: " + reason);
                            },
                            [this](const PlanStatistics& plan) { otherPlan(plan); }});
  connectPlans();
  connectDrives();
}

void PlanPanel::tick() {
  queue_.callAvailable();
  calls_.poll();
  model_.setPlanners(nodes_->plan.servers());
  model_.setDrivers(nodes_->drive.servers());
  if (const auto request = model_.tick(now())) sendPlan(*request);
  if (drawn_ != model_.revision()) {
    compared_.clear();
    explanation_.markers.clear();
    handles_.show(model_.points());
    draw();
  }
  widgets_.show(model_);
}

void PlanPanel::draw() {
  drawn_ = model_.revision();
  visualization_msgs::MarkerArray all = panelMarkers(model_.path(), compared_);
  all.markers.insert(all.markers.end(), explanation_.markers.begin(), explanation_.markers.end());
  publishLatched(markers_, all);
}

void PlanPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString name;
  if (config.mapGetString("Namespace", &name)) widgets_.name_space->setText(name);
  connectNodes();
}

void PlanPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Namespace", widgets_.name_space->text());
}

}  // namespace grid_path_planner::nodes
