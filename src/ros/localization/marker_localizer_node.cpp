#include "ros/localization/marker_localizer_node.h"

#include <ros/console.h>

#include <cmath>
#include <utility>

#include "grid_path_planner/MarkerLocalizerConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "localization/measurement_check.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/network_text.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/parameters.h"
#include "ros/localization/camera_messages.h"
#include "ros/localization/sensor_messages.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopSource;
using base::StopToken;
using diagnostic_msgs::DiagnosticStatus;
using vision::PanelPose;

namespace {

void nameFrames(MarkerLocalizerOptions& options) {
  options.map_frame = frameName(options.map_frame);
  options.odom_frame = frameName(options.odom_frame);
  options.base_frame = frameName(options.base_frame);
}

MarkerLocalizerOptions loadMarkerLocalizerOptions(const ros::NodeHandle& private_nh,
                                                  const NodeFiles& files) {
  MarkerLocalizerOptions options;
  loadParameters(private_nh, options);
  options.layout = files.named("layout", options.layout);
  nameFrames(options);
  checkMarkerLocalizerOptions(options);
  warnUnknownParameters(private_nh, optionNames<MarkerLocalizerOptions>());
  return options;
}

vision::MarkerLayout loadLayout(const MarkerLocalizerOptions& options, const NodeFiles& files) {
  return files.read("layout", options.layout, markerLayoutFiles(), [&](const std::string& file) {
    return vision::readMarkerLayout(file, {options.reading, ShutdownFlag().token()});
  });
}

// As the parameters have it: it is known exactly.
std::optional<PanelPose> givenPanel(const MarkerLocalizerOptions& o) {
  if (!o.panel_known) return {};
  PanelPose panel;
  panel.map_from_panel = Eigen::Translation3d(o.panel_x, o.panel_y, o.panel_z) *
                         Eigen::AngleAxisd(o.panel_yaw, Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(o.panel_pitch, Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(o.panel_roll, Eigen::Vector3d::UnitX());
  return panel;
}

// Two cameras on one topic: by the lens of the other the vehicle is a metre off, and no residual shows it.
void checkSameCamera(const std::string& image, const std::string& info) {
  checkNetworkText("its frame", image);
  if (!info.empty() && frameName(image) != info)
    throw InputError("its frame is '" + frameName(image) + "', that of the camera_info '" + info +
                     "': another camera's");
}

// Root mean square, pixels.
double residualOf(const vision::MarkerFix& fix) {
  if (fix.candidates.empty()) return 0.0;
  return std::sqrt(fix.candidates.front().squared_error /
                   (4.0 * static_cast<double>(fix.views.size())));
}

}  // namespace

MarkerLocalizerNode::MarkerLocalizerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                         const NodeFiles& files)
    : options_(loadMarkerLocalizerOptions(private_nh, files)),
      layout_(loadLayout(options_, files)),
      transforms_(nh),
      publisher_(nh),
      sightings_(options_.learning),
      diagnostics_(nh, private_nh, private_nh.getNamespace()),
      looker_([](const std::string& error) { tellGivenUp("An image", error); }) {
  usePanel(givenPanel(options_));
  reconfigurable_ = std::make_unique<Reconfigurable<MarkerLocalizerConfig, MarkerLocalizerOptions>>(
      private_nh, options_, [this](const MarkerLocalizerOptions& options) { use(options); });
  diagnostics_.add("markers", this, &MarkerLocalizerNode::diagnose);
  diagnostics_timer_ = diagnosticsTimer(nh, diagnostics_);
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double seconds) { timeWentBack(seconds); });
  listen(nh, private_nh);
}

MarkerLocalizerNode::~MarkerLocalizerNode() {
  diagnostics_timer_.stop();
  infos_->shutdown();
  images_->shutdown();
  learn_panel_.shutdown();
}

void MarkerLocalizerNode::listen(ros::NodeHandle& nh, ros::NodeHandle& private_nh) {
  using sensor_msgs::CameraInfo, sensor_msgs::Image;
  infos_ = std::make_unique<Input<CameraInfo>>(
      nh, "camera/camera_info", rulesOf("marker_localizer", "camera/camera_info"), transforms_,
      [this](const Input<CameraInfo>::Arrival& info) { onInfo(*info.message); });
  images_ = std::make_unique<Input<Image>>(nh, "camera/image_raw", imageRules(), transforms_,
                                           Input<Image>::OnReady{[this] { lookAtNext(); }});
  using std_srvs::Trigger;
  learn_panel_ =
      advertiseService<Trigger>(private_nh, "learn_panel", [this](auto&, auto& response) {
        learnPanel(response);
        return true;
      });
}

InputRules MarkerLocalizerNode::imageRules() const {
  InputRules rules = rulesOf("marker_localizer", "camera/image_raw");
  rules.oldest = options_.max_age;
  return rules;
}

void MarkerLocalizerNode::use(MarkerLocalizerOptions options) {
  nameFrames(options);
  checkMarkerLocalizerOptions(options);
  if (options.layout != options_.layout || options.map_frame != options_.map_frame ||
      options.odom_frame != options_.odom_frame || options.base_frame != options_.base_frame)
    throw InputError(
        "layout, map_frame, odom_frame and base_frame cannot be changed while the node runs");
  const bool forgets = options_.panel_known && !options.panel_known;
  options_ = options;
  if (images_) images_->setRules(imageRules());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sightings_.use(options.learning);
  }
  if (options.panel_known || forgets) usePanel(givenPanel(options));
}

void MarkerLocalizerNode::usePanel(const std::optional<PanelPose>& panel) {
  panel_ = panel;
  const std::lock_guard<std::mutex> lock(mutex_);
  sightings_.clear();
  if (panel_) publisher_.publishPanel(*panel_, options_.map_frame, ros::Time::now());
}

void MarkerLocalizerNode::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by " << seconds << " s: images and tf are forgotten");
  const std::lock_guard<std::mutex> lock(mutex_);
  sightings_.clear();
  tally_.newest.reset();
}

void MarkerLocalizerNode::onInfo(const sensor_msgs::CameraInfo& message) {
  checkNetworkText("its frame", message.header.frame_id);
  camera_ = Camera{calibrationOf(message), frameName(message.header.frame_id)};
}

// With what is in force now.
void MarkerLocalizerNode::lookAtNext() {
  looker_.post(
      [this, camera = camera_, options = options_, panel = panel_](const StopSource& stop) {
        try {
          images_->useNext([&](const Input<sensor_msgs::Image>::Arrival& image) {
            if (!camera) throw InputError("no camera_info that can be used has come yet");
            checkSameCamera(image.message->header.frame_id, camera->frame);
            lookAt({image.message, camera->calibration, options, panel}, stop.token());
          });
        } catch (const base::Stopped&) {  // the node ends
        }
      },
      "image");
}

// In the thread of the images.
void MarkerLocalizerNode::lookAt(const MarkerImage& image, const StopToken& stop) {
  MarkerAnswer answer = answerOf(image, layout_, transforms_, stop);
  publisher_.publish(image, answer, layout_);
  answer.grey = {};
  const std::lock_guard<std::mutex> lock(mutex_);
  if (answer.sighting) sightings_.add(*answer.sighting);
  if (answer.base) ++tally_.poses;
  tally_.newest = std::move(answer);
  tally_.newest_stamp = image.message->header.stamp;
}

void MarkerLocalizerNode::learnPanel(std_srvs::Trigger::Response& response) {
  try {
    if (panel_) throw InputError("the panel's pose is known already");
    PanelPose learnt;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      learnt = sightings_.learnt();
    }
    usePanel(learnt);
    response.success = true;
    const Eigen::Vector3d position = learnt.map_from_panel.translation();
    response.message = "the panel is at " + std::to_string(position.x()) + ", " +
                       std::to_string(position.y()) + ", " + std::to_string(position.z());
  } catch (const InputError& error) {
    response.message = error.what();
  }
  ROS_INFO_STREAM("~learn_panel: " << response.message);
}

void MarkerLocalizerNode::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  if (images_->counts().received == 0) return status.summary(DiagnosticStatus::OK, "not heard");
  if (const auto problem = images_->problem())
    return status.summary(DiagnosticStatus::WARN, *problem);
  if (!tally_.newest) return status.summary(DiagnosticStatus::OK, "no image of this time yet");
  const MarkerAnswer& newest = *tally_.newest;
  if (!newest.fix.fits)
    status.summary(DiagnosticStatus::ERROR, newest.reason);
  else if (!newest.base)
    status.summary(DiagnosticStatus::WARN, "no pose: " + newest.reason);
  else
    status.summary(DiagnosticStatus::OK,
                   "a pose by " + std::to_string(newest.fix.views.size()) + " markers");
}

void MarkerLocalizerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const vision::MarkerFix fix = tally_.newest ? tally_.newest->fix : vision::MarkerFix();
  const double age = secondsBetween(tally_.newest_stamp, ros::Time::now());
  const std::uint64_t taken = images_->counts().used;
  const auto before = std::exchange(tally_.diagnosed, taken);
  summarize(status);
  status.add("rate (Hz)", static_cast<double>(taken - before) / kDiagnosisPeriod);
  status.add("age (s)", tally_.newest ? std::to_string(age) : "none");
  status.add("poses", tally_.poses);
  status.add("markers seen", fix.views.size());
  status.add("markers that the layout does not have", fix.unknown);
  status.add("residual (pixels)", residualOf(fix));
  status.add("panel", panel_ ? "known" : "not known");
  addTo(status, "images", images_->counts());
  addTo(status, "camera_info", infos_->counts());
}

}  // namespace grid_path_planner::nodes
