#include "panel/panel_model.h"

#include <algorithm>

#include "panel/shown_text.h"

namespace grid_path_planner::panel {

using path::Path;
using path::Pose;

namespace {

constexpr std::size_t kLongestSentence = 400, kLongestName = 40;
constexpr std::size_t kMostEnded = 20, kLongestGoal = 256;
constexpr double kOwnEcho = 1.0;  // s, in which the planner repeats its answer to the panel for all

std::string figuresText(const PlanFigures& figures) {
  return shownText(figures.planner, kLongestName) + ": cost " + shownNumber(figures.cost) + ", " +
         shownNumber(figures.length) + " m, turning " + shownNumber(figures.turning) +
         " rad, clearance " + shownNumber(figures.clearance) + " m, " +
         shownNumber(figures.expanded) + " cells expanded, " + shownNumber(figures.time) + " ms";
}

std::string countText(std::size_t count, const std::string& what) {
  if (count == 1) return what;
  return count == 0 ? "no " + what : std::to_string(count) + " × " + what;
}

}  // namespace

void PanelModel::setPlanners(std::size_t count) {
  if (count == 0 && planners_ > 0 && planning_.busy()) {
    planning_.giveUp(base::Status::CANCELLED,
                     "path_planner is gone: press Plan again when it is back");
    showOutcome();
  }
  planners_ = count;
}

void PanelModel::setDrivers(std::size_t count) {
  if (count == 0 && driving_)
    loseDrive("navigate_path is gone: the vehicle stops when commands cease");
  drivers_ = count;
}

void PanelModel::place(RoutePoints::Id id, const std::string& frame, const Pose& pose) {
  pointsChanged(points_.set(id, frame, pose));
}

void PanelModel::addVia(const std::string& frame, const Pose& pose) {
  pointsChanged(points_.addVia(frame, pose));
}

void PanelModel::startAtVehicle() {
  points_.startAtVehicle();
  pointsChanged("");
}

void PanelModel::removeLastVia() {
  points_.removeLastVia();
  pointsChanged("");
}

void PanelModel::setBestOrder(bool best) {
  best_order_ = best;
  if (points_.via().size() > 1) planAgain();
}

void PanelModel::clear() {
  points_.clear();
  follows_ = false;
  path_ = Path();
  figures_.clear();
  ++revision_;
  say(Tone::CALM, "Set a goal with the tool Plan Goal, then press Plan");
}

void PanelModel::pointsChanged(const std::string& complaint) {
  ++revision_;
  if (!complaint.empty()) {
    say(Tone::BAD, complaint);
  } else if (follows_) {
    plan();
  } else {
    say(Tone::CALM,
        points_.goal() ? "Press Plan, Compare or Explain" : "Set a goal with the tool Plan Goal");
  }
}

void PanelModel::plan() {
  if (planners_ == 0 || !points_.goal()) return;
  follows_ = true;
  planning_.ask(points_, best_order_);
  say(Tone::BUSY, "Planning ...");
}

void PanelModel::planAgain() {
  if (follows_) plan();
}

std::optional<PlanRequest> PanelModel::tick(double now) {
  if (planning_.overdue(now)) {
    planning_.giveUp(base::Status::TIMEOUT, "path_planner has not answered for " +
                                                shownDuration(RoutePlanning::kPatience));
    showOutcome();
  }
  if (driving_ && now - drive_heard_ > kPatienceWithDrives)
    loseDrive("navigate_path has not been heard for " + shownDuration(kPatienceWithDrives) +
              ": what the vehicle does is not known");
  return planning_.next(now);
}

void PanelModel::planHeard(unsigned id, const std::string& phase, double now) {
  planning_.heard(id, now);
  if (id == planning_.pending()) say(Tone::BUSY, "Planning: " + phase + " ...");
}

void PanelModel::planAnswered(unsigned id, const PlanAnswer& answer, double now) {
  answered_ = now;
  if (planning_.take(id, answer, now)) showOutcome();
}

void PanelModel::otherPlan(const PlanAnswer& answer, double now) {
  if (planning_.busy() || now - answered_ < kOwnEcho) return;
  figures_ = figuresText(answer.figures);
  say(answer.found() ? Tone::GOOD : Tone::BAD, answer.status + ": " + answer.message);
}

unsigned PanelModel::cancelPlan() {
  if (!planning_.busy()) return 0;
  const unsigned pending = planning_.pending();
  follows_ = false;
  planning_.giveUp(base::Status::CANCELLED, "planning was cancelled");
  showOutcome();
  return pending;
}

void PanelModel::showOutcome() {
  const PlanAnswer& outcome = planning_.outcome();
  path_ = outcome.path;
  figures_ = outcome.figures.planner.empty() ? "" : figuresText(outcome.figures);
  ++revision_;
  say(outcome.found() ? Tone::GOOD : Tone::BAD, outcome.status + ": " + outcome.message);
}

void PanelModel::loaded(const std::string& file, const Path& path) {
  cancelPlan();
  clear();
  path_ = path;
  say(Tone::GOOD, std::to_string(path.poses.size()) + " waypoints of " + file);
}

void PanelModel::callBegan(Call call) {
  call_ = call;
  say(Tone::BUSY, call == Call::COMPARE ? "Comparing ..." : "Explaining ...");
}

void PanelModel::callEnded(Tone tone, const std::string& sentence) {
  call_ = Call::NONE;
  say(tone, sentence);
}

void PanelModel::driveSent(const std::string& goal, double now) {
  driving_ = true;
  driven_ = goal.substr(0, kLongestGoal);
  drive_heard_ = now;
  drive_state_ = "starting";
  waypoint_ = 0;
  progress_.clear();
  say(Tone::BUSY, "Driving");
}

void PanelModel::driveHeard(const std::string& goal, const DriveFeedback& feedback, double now) {
  const std::string id = goal.substr(0, kLongestGoal);
  if (std::find(ended_.begin(), ended_.end(), id) != ended_.end()) return;
  driving_ = true;
  driven_ = id;
  drive_heard_ = now;
  drive_state_ = shownText(feedback.state, kLongestName);
  waypoint_ = feedback.waypoint;
  progress_.add(feedback.time, feedback.remaining);
}

void PanelModel::driveEnded(const std::string& goal, bool arrived, const std::string& status,
                            const std::string& message) {
  const std::string id = goal.substr(0, kLongestGoal);
  ended_.push_back(id);
  if (ended_.size() > kMostEnded) ended_.pop_front();
  if (!driving_ || id == driven_) standStill(status);  // or another goal has taken its place
  say(arrived ? Tone::GOOD : Tone::BAD, status + ": " + message);
}

void PanelModel::leaveDriver() {
  standStill("");
}

void PanelModel::standStill(const std::string& state) {
  driving_ = false;
  drive_state_ = shownText(state, kLongestName);
  progress_.clear();
}

void PanelModel::loseDrive(const std::string& why) {
  standStill("LOST");
  say(Tone::BAD, "LOST: " + why);
}

void PanelModel::say(Tone tone, const std::string& sentence) {
  tone_ = tone;
  sentence_ = shownText(sentence, kLongestSentence);
}

Buttons PanelModel::buttons() const {
  Buttons may;
  const bool asks = planners_ > 0 && points_.goal() && call_ == Call::NONE;
  may.plan = planners_ > 0 && points_.goal();
  may.compare = may.explain = asks && !planning_.busy();
  may.drive = drivers_ > 0 && !path_.empty() && !planning_.busy() && !driving_;
  // A drive may be another's: it can always be paused.
  may.pause = drivers_ > 0 && drive_state_ != "paused";
  may.resume = drivers_ > 0 && (!driving_ || drive_state_ == "paused");
  may.cancel = drivers_ > 0 || planning_.busy();
  may.save = !path_.empty();
  return may;
}

std::string PanelModel::nodesText() const {
  return countText(planners_, "path_planner") + ", " + countText(drivers_, "navigate_path");
}

std::string PanelModel::driveText() const {
  if (!driving_) return drive_state_.empty() ? "no drive is reported" : drive_state_;
  const std::optional<double> left = progress_.secondsLeft();
  return drive_state_ + ", waypoint " + std::to_string(waypoint_) + ", time left " +
         (left ? shownDuration(*left) : "unknown");
}

}  // namespace grid_path_planner::panel
