#include "ros/driving/teleop_joy_node.h"

#include <ros/callback_queue_interface.h>
#include <ros/console.h>

#include "grid_path_planner/TeleopJoyConfig.h"
#include "grid_path_planner/base/options.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/outgoing/diagnostics_timer.h"
#include "ros/guard/parameters.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr int kMostNotes = 100;  // that wait for the log

TeleopJoyOptions loadTeleopJoyOptions(const ros::NodeHandle& private_nh) {
  TeleopJoyOptions options;
  loadParameters(private_nh, options);
  checkTeleopJoyOptions(options);
  warnUnknownParameters(private_nh, optionNames<TeleopJoyOptions>());
  return options;
}

}  // namespace

void checkTeleopJoyOptions(const TeleopJoyOptions& options) {
  checkOptionLimits(options);
}

TeleopJoyNode::TeleopJoyNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh)
    : nh_(nh),
      options_(loadTeleopJoyOptions(private_nh)),
      commands_(private_nh.getNamespace(),
                {{nh.resolveName("cmd_vel")}, {}, nh.resolveName("manual_control"), true}),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  loop_ = std::make_unique<JoystickLoop>(
      nh_, options_,
      [this](JoystickLoop::Level level, const std::string& sentence) { note(level, sentence); });
  commands_.refuseSimultaneous();
  loop_->start();  // nothing is commanded before
  reconfigurable_ = std::make_unique<Reconfigurable<TeleopJoyConfig, TeleopJoyOptions>>(
      private_nh, options_, [this](const TeleopJoyOptions& options) { use(options); });
  diagnostics_.add("joystick", this, &TeleopJoyNode::diagnose);
  diagnostics_.add("other nodes", &others_, &OtherCommanders::report);
  diagnostics_timer_ = diagnosticsTimer(nh_, diagnostics_);
}

TeleopJoyNode::~TeleopJoyNode() {
  diagnostics_timer_.stop();
  stop();
  reconfigurable_.reset();
  loop_.reset();
  nh_.getCallbackQueue()->removeByID(reinterpret_cast<std::uint64_t>(this));
}

void TeleopJoyNode::use(const TeleopJoyOptions& options) {
  checkTeleopJoyOptions(options);
  loop_->setOptions(options);
  options_ = options;
}

void TeleopJoyNode::note(JoystickLoop::Level level, const std::string& sentence) {
  if (*notes_ >= kMostNotes) return;
  ++*notes_;
  const auto log = [waiting = notes_, level, sentence] {
    --*waiting;
    if (level == JoystickLoop::Level::ERROR)
      ROS_ERROR_STREAM(sentence);
    else if (level == JoystickLoop::Level::WARN)
      ROS_WARN_STREAM(sentence);
    else
      ROS_INFO_STREAM(sentence);
  };
  nh_.getCallbackQueue()->addCallback(callbackOf(log), reinterpret_cast<std::uint64_t>(this));
}

void TeleopJoyNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(DiagnosticStatus::OK,
                 loop_->commands() ? "the joystick commands" : "the joystick commands nothing");
  status.add("scheduling of commands", loop_->gate().scheduling());
}

}  // namespace grid_path_planner::nodes
