#include "ros/localization/vehicle_localizer_node.h"

#include <ros/console.h>
#include <std_srvs/Trigger.h>

#include <utility>

#include "grid_path_planner/VehicleLocalizerConfig.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/localization/inputs/input_health.h"
#include "ros/localization/inputs/vehicle_frames.h"
#include "ros/localization/other_odometry.h"

namespace grid_path_planner::nodes {

using base::InputError;
using diagnostic_msgs::DiagnosticStatus;
using geometry_msgs::PoseWithCovarianceStamped;
using localization::LocalizationReport;
using localization::LocalizationStatus;
using localization::Source;
using localization::Verdict;

namespace {

void nameFrames(VehicleLocalizerOptions& options) {
  for (std::string* frame : {&options.map_frame, &options.odom_frame, &options.base_frame,
                             &options.usbl_frame, &options.depth_frame})
    *frame = frameName(*frame);
}

VehicleLocalizerOptions loadVehicleLocalizerOptions(const ros::NodeHandle& private_nh) {
  VehicleLocalizerOptions options;
  loadParameters(private_nh, options);
  nameFrames(options);
  checkVehicleLocalizerOptions(options);
  warnUnknownParameters(private_nh, optionNames<VehicleLocalizerOptions>());
  return options;
}

// The frames whose transform to their parent is this node's.
std::vector<std::string> childrenOf(const VehicleLocalizerOptions& options) {
  std::vector<std::string> children;
  if (options.publish_map_to_odom) children.push_back(options.odom_frame);
  if (options.publish_odom_to_base) children.push_back(options.base_frame);
  return children;
}

std::string topicOf(Source source, const VehicleLocalizerOptions& options) {
  switch (source) {
    case Source::IMU:
      return "imu/data";
    case Source::DVL:
      return "dvl/twist";
    case Source::DEPTH:
      return options.use_pressure ? "pressure" : "depth";
    case Source::USBL:
      return "usbl/pose";
    case Source::MARKER:
      return "marker_pose";
    case Source::COMMAND:
      return "cmd_vel";
    default:
      return "initialpose";
  }
}

InputRules rulesOf(Source source, const VehicleLocalizerOptions& options) {
  InputRules rules = nodes::rulesOf("vehicle_localizer", topicOf(source, options));
  rules.oldest = options.localizer.filter.history;
  if (source != Source::SET_POSE)
    rules.silent_after = localization::longestSilence(source, options.localizer);
  return rules;
}

template <class Snapshot>
std::optional<PublishedEstimate> published(const localization::VehicleLocalizer& localizer,
                                           const Snapshot& snapshot) {
  if (!snapshot) return {};
  return PublishedEstimate{snapshot->estimate, localizer.rateOf(*snapshot)};
}

// Why it was not used; empty: it was.
std::string given(Input<PoseWithCovarianceStamped>& poses,
                  const PoseWithCovarianceStamped& message) {
  const auto used = poses.counts().used;
  if (const auto why = poses.give(boost::make_shared<PoseWithCovarianceStamped>(message)))
    return *why;
  return poses.counts().used > used ? "" : "it is ahead of ROS time, and waits for it";
}

}  // namespace

VehicleLocalizerNode::VehicleLocalizerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                           const NodeFiles& files)
    : options_(loadVehicleLocalizerOptions(private_nh)),
      rivals_(childrenOf(options_)),
      transforms_(nh, [this](const tf2_msgs::TFMessage& message, const std::string& node,
                             bool is_static) { rivals_.hear(message, node, is_static); }),
      localizer_(options_.localizer),
      kept_(files.saveFolder().path(), private_nh.getNamespace()),
      messages_([this](const std::string& target,
                       const std::string& source) { return placeOnVehicle(target, source); },
                options_),
      publisher_(nh, options_),
      fixes_(nh),
      status_publisher_(nh.advertise<std_msgs::String>("localization_status", 1, true)),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  if (const auto heading = kept_.begin()) localizer_.beginWith(*heading);
  announce(localizer_.report({}), false);
  subscribe(nh);
  offerServices(nh, private_nh);
  reconfigurable_ =
      std::make_unique<Reconfigurable<VehicleLocalizerConfig, VehicleLocalizerOptions>>(
          private_nh, options_, [this](const VehicleLocalizerOptions& options) { use(options); });
  on_jump_back_ = NodeTime::of(nh).onJumpBack([this](double seconds) { timeWentBack(seconds); });
  publish_timer_ = guardedTimer(nh, 1.0 / options_.publish_rate, [this] { onTimer(); });
  startDiagnostics(nh);
}

VehicleLocalizerNode::~VehicleLocalizerNode() = default;

// Not through the map or the odometry, which are this node's own estimate.
Eigen::Isometry3d VehicleLocalizerNode::placeOnVehicle(const std::string& target,
                                                       const std::string& source) const {
  const Eigen::Isometry3d found = mountingIn(transforms_, target, source);
  checkOnVehicle(transforms_, target, source, {options_.map_frame, options_.odom_frame});
  return found;
}

template <class Message, class Use>
Input<Message>& VehicleLocalizerNode::listen(Source source, ros::NodeHandle& nh, const Use& use) {
  auto input = std::make_unique<Input<Message>>(
      nh, topicOf(source, options_), rulesOf(source, options_), transforms_,
      [use](const typename Input<Message>::Arrival& arrival) { use(*arrival.message); });
  Input<Message>& listening = *input;
  inputs_[source] = std::move(input);
  return listening;
}

void VehicleLocalizerNode::subscribe(ros::NodeHandle& nh) {
  const auto taking = [this](auto measurement) {
    return [this, measurement](const auto& message) { take((messages_.*measurement)(message)); };
  };
  listen<sensor_msgs::Imu>(Source::IMU, nh,
                           [this](const sensor_msgs::Imu& message) { onImu(message); });
  using geometry_msgs::Twist, geometry_msgs::TwistWithCovarianceStamped;
  listen<TwistWithCovarianceStamped>(Source::DVL, nh, taking(&SensorMessages::dvl));
  listen<PoseWithCovarianceStamped>(Source::USBL, nh, taking(&SensorMessages::usbl));
  listen<PoseWithCovarianceStamped>(Source::MARKER, nh, taking(&SensorMessages::marker));
  if (options_.use_pressure)
    listen<sensor_msgs::FluidPressure>(Source::DEPTH, nh, taking(&SensorMessages::pressure));
  else
    listen<PoseWithCovarianceStamped>(Source::DEPTH, nh, taking(&SensorMessages::depth));
  listen<Twist>(Source::COMMAND, nh, [this](const Twist& message) { onCommand(message); });
}

void VehicleLocalizerNode::offerServices(ros::NodeHandle& nh, ros::NodeHandle& private_nh) {
  auto& poses = listen<PoseWithCovarianceStamped>(
      Source::SET_POSE, nh, [this](const PoseWithCovarianceStamped& message) {
        take(messages_.setPose(message, NodeTime::now()));
      });
  services_.push_back(
      advertiseService<SetPose>(private_nh, "set_pose", [&poses](auto& request, auto& response) {
        response.message = given(poses, request.pose);
        response.success = response.message.empty();
        if (response.success) response.message = "set";
        return true;
      }));
  services_.push_back(
      advertiseService<std_srvs::Trigger>(private_nh, "reset", [this](auto&, auto& response) {
        ROS_INFO("Asked by ~reset: everything begins anew");
        beginAnew();
        response.success = true;
        response.message = "everything begins anew";
        return true;
      }));
}

void VehicleLocalizerNode::startDiagnostics(ros::NodeHandle& nh) {
  diagnostics_.add("localization", this, &VehicleLocalizerNode::diagnose);
  for (const Source source : {Source::IMU, Source::DVL, Source::DEPTH, Source::USBL, Source::MARKER,
                              Source::COMMAND, Source::SET_POSE, Source::HEADING})
    diagnostics_.add(nameOf(source),
                     [this, source](diagnostic_updater::DiagnosticStatusWrapper& status) {
                       diagnoseInput(source, status);
                     });
  diagnostics_timer_ = diagnosticsTimer(nh, diagnostics_);
}

void VehicleLocalizerNode::use(VehicleLocalizerOptions options) {
  nameFrames(options);
  checkVehicleLocalizerOptions(options);
  if (options.map_frame != options_.map_frame || options.odom_frame != options_.odom_frame ||
      options.base_frame != options_.base_frame || options.use_pressure != options_.use_pressure ||
      options.publish_map_to_odom != options_.publish_map_to_odom ||
      options.publish_odom_to_base != options_.publish_odom_to_base ||
      options.publish_rate != options_.publish_rate)
    throw InputError(
        "map_frame, odom_frame, base_frame, use_pressure, publish_map_to_odom, "
        "publish_odom_to_base and publish_rate cannot be changed while the node runs");
  localizer_.use(options.localizer);
  messages_.use(options);
  options_ = options;
  for (auto& [source, input] : inputs_) input->setRules(rulesOf(source, options_));
}

void VehicleLocalizerNode::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by " << seconds << " s: everything begins anew");
  beginAnew(headingAfterStep(localizer_.knownHeading(), seconds, stampOf(ros::Time::now()),
                             ros::Time::isSimTime()));
}

// But with what is known of the IMU's heading, if anything is.
void VehicleLocalizerNode::beginAnew(const std::optional<localization::KnownHeading>& heading) {
  localizer_.reset();
  if (heading) {
    localizer_.beginWith(*heading);
    kept_.keep(*heading);
  } else {
    kept_.forget();
  }
  messages_.reset();
  transforms_.clear();
  rivals_.reset();
  publisher_.reset();
  fixes_.clear();
  report_ = {};
}

// Throws std::runtime_error for one that is not used.
void VehicleLocalizerNode::take(const localization::Measurement& measurement) {
  const Verdict verdict = localizer_.add(measurement);
  fixes_.add(measurement, verdict, options_.map_frame);
  if (verdict == Verdict::RESET)
    ROS_WARN_STREAM(options_.localizer.filter.reset_after
                    << " measurements in a row of " << nameOf(measurement.source)
                    << " agree with each other and not with the pose: what they measure begins "
                       "anew");
}

void VehicleLocalizerNode::onImu(const sensor_msgs::Imu& message) {
  take(messages_.imu(message));
  messages_.keep(message);
  if (const auto heading = messages_.heading(message)) take(*heading);
  const ros::Time stamp = normalized(message.header.stamp);
  if (publisher_.isDue(stamp)) publish(stamp);
}

// Several within one step of simulated time are one command.
void VehicleLocalizerNode::onCommand(const geometry_msgs::Twist& message) {
  const ros::Time now = ros::Time::now();
  if (now == inputs_.at(Source::COMMAND)->newest()) return;
  take(messages_.command(message, now));
}

// While no IMU does.
void VehicleLocalizerNode::onTimer() {
  if (!NodeTime::isThere()) return;
  const ros::Time now = ros::Time::now();
  const double late = 3.0 / options_.publish_rate;
  if (publisher_.isDue(now - ros::Duration(std::min(late, now.toSec())))) publish(now);
}

void VehicleLocalizerNode::publish(const ros::Time& stamp) {
  const auto time = stampOf(stamp);
  if (!localizer_.isFinite()) {
    ROS_ERROR("An estimate is no number any more: everything begins anew");
    beginAnew();
  }
  report_ = localizer_.report(time);
  keepHeading(time);
  const std::string withheld = publishPoses(stamp);
  if (!withheld.empty()) {
    static LogThrottle seldom(5.0);
    ROS_WARN_STREAM_COND(seldom.isDue(), withheld);
    report_.sentence = withheld + "; " + report_.sentence;
    if (report_.status == LocalizationStatus::OK) report_.status = LocalizationStatus::DEGRADED;
  }
  announce(report_, !withheld.empty());
}

// What is not published, and why; empty: all is.
std::string VehicleLocalizerNode::publishPoses(const ros::Time& stamp) {
  const auto time = stampOf(stamp);
  PublishedPoses poses{
      published(localizer_, localizer_.mapAt(time)),
      published(localizer_, localizer_.odometryAt(time)),
      report_.status == LocalizationStatus::OK || report_.status == LocalizationStatus::DEGRADED};
  if ((!poses.odometry && !poses.map) || !rivals_.isKnown()) return {};
  try {
    const localization::Mounting base = messages_.base();
    localizer_.setBase(base.rotation);
    const bool by_other = options_.publish_map_to_odom && !options_.publish_odom_to_base &&
                          poses.map && poses.map_to_odom;
    if (by_other)
      poses.map_to_other_odometry = mapToOtherOdometry(
          transforms_, {options_.odom_frame, options_.base_frame}, localizer_, base, stamp);
    publisher_.publish(poses, base, stamp, rivals_);
    if (!by_other || poses.map_to_other_odometry) return {};
    return "No " + options_.map_frame + " -> " + options_.odom_frame +
           " is published: publish_odom_to_base is false, and tf has no " + options_.odom_frame +
           " -> " + options_.base_frame + " of the last 0.5 s";
  } catch (const std::runtime_error& error) {
    return "No pose is published: " + std::string(error.what());
  }
}

// Where the IMU's is used all the time it is no worse at a start.
void VehicleLocalizerNode::keepHeading(localization::Stamp time) {
  if (report_.status != LocalizationStatus::OK || options_.use_heading || !kept_.isDue()) return;
  if (const auto heading = localizer_.headingAt(time)) kept_.keep(*heading);
}

// In the log when the status changes, another node publishes what is ours, or something is withheld.
void VehicleLocalizerNode::announce(const LocalizationReport& report, bool is_withheld) {
  const std::string rival = rivals_.rival();
  const std::string told = nameOf(report.status) + rival + (is_withheld ? ", withheld" : "");
  if (told == told_.what) return;
  told_.what = told;
  told_.message.data = std::string(nameOf(report.status)) + ": " + report.sentence;
  publishLatched(status_publisher_, told_.message);
  ROS_INFO_STREAM(told_.message.data);
  if (!rival.empty()) ROS_ERROR_STREAM("No transform is published: " << rival);
}

void VehicleLocalizerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  publishLatched(status_publisher_,
                 told_.message);  // whoever drives by it hears that this node lives
  const std::string rival = rivals_.rival();
  const bool well = report_.status == LocalizationStatus::OK && rival.empty();
  const bool lost = report_.status == LocalizationStatus::LOST || !rival.empty();
  status.summary(well   ? DiagnosticStatus::OK
                 : lost ? DiagnosticStatus::ERROR
                        : DiagnosticStatus::WARN,
                 std::string(nameOf(report_.status)) + ": " + report_.sentence);
  if (!rival.empty()) status.mergeSummary(DiagnosticStatus::ERROR, rival);
  status.add("deviation (m)", report_.deviation);
  status.add("deviation of the attitude (deg)", report_.angle_deviation);
}

void VehicleLocalizerNode::diagnoseInput(Source source,
                                         diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto now = stampOf(ros::Time::now());
  auto statistics = localization::inputStatistics(localizer_.map(), source, now);
  if (!statistics.age) statistics.age = localizer_.sinceUsed(source, now);
  const InputBase& input = *inputs_.at(source == Source::HEADING ? Source::IMU : source);
  const bool is_heard = source != Source::HEADING || options_.use_heading;
  const InputCounts counts = is_heard ? input.counts() : InputCounts();
  const InputHealth health =
      healthOf(statistics, counts, input.problem(), expectationOf(source, options_));
  status.summary(health.is_good ? DiagnosticStatus::OK : DiagnosticStatus::WARN, health.sentence);
  status.add("received", counts.received);
  status.add("rate (Hz)", statistics.rate);
  status.add("age (s)", statistics.age ? std::to_string(*statistics.age) : "none lately");
  status.add("taken", statistics.counts.taken);
  status.add("gated", statistics.counts.gated);
  status.add("resets", statistics.counts.resets);
  status.add("refused", counts.refusedInAll());
  status.add("refused last because", counts.last_refusal);
  status.add("NIS, mean", statistics.nis_mean);
  status.add("NIS, 95 % low", statistics.nis_bounds.low);
  status.add("NIS, 95 % high", statistics.nis_bounds.high);
}

}  // namespace grid_path_planner::nodes
