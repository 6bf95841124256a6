#include "planning/via/via_plan.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <string>

#include "grid_path_planner/path/headings.h"
#include "path/motions.h"
#include "planning/message_text.h"
#include "planning/via/visiting_order.h"

namespace grid_path_planner::planning {

using base::Status, base::Stopped, base::StopSource, base::StopToken;
using path::applyHeadings, path::Path, path::Pose;
using planners::memoryLimitOf;

const std::vector<std::pair<const char*, ViaOrder>>& choicesOf(ViaOrder) {
  static const std::vector<std::pair<const char*, ViaOrder>> choices = {{"given", ViaOrder::GIVEN},
                                                                        {"best", ViaOrder::BEST}};
  return choices;
}

namespace {

constexpr double kSamePlace = 1e-9;  // m

// "via-point 2", from 1.
std::string viaName(std::size_t index) {
  return "via-point " + std::to_string(index + 1);
}

// "via-points 2, 5 and 6".
std::string viaNames(const std::vector<std::size_t>& indices) {
  if (indices.size() == 1) return viaName(indices.front());
  std::string text = "via-points ";
  for (std::size_t i = 0; i < indices.size(); ++i)
    text += (i == 0                    ? ""
             : i + 1 == indices.size() ? " and "
                                       : ", ") +
            std::to_string(indices[i] + 1);
  return text;
}

// What follows the length and the cost in the message of a plan.
std::string notesOf(const std::string& message) {
  const std::size_t begin = message.find("; ");
  return begin == std::string::npos ? "" : message.substr(begin + 2);
}

// Whether a plan failed for where it leads.
bool isOfGoal(Status status) {
  return status == Status::GOAL_OUTSIDE_MAP || status == Status::GOAL_OCCUPIED ||
         status == Status::UNREACHABLE;
}

std::size_t bytesOf(const Plan& plan) {
  return (plan.path.poses.size() + plan.waypoints.poses.size()) * sizeof(Pose) +
         plan.expanded.size() * sizeof(Eigen::Vector2d);
}

// Adds the poses of a leg, which begins where the path ends: one of two poses there is enough.
void append(Path& path, const Path& leg) {
  path.frame_id = leg.frame_id;
  std::vector<Pose>& poses = path.poses;
  if (!poses.empty() && (poses.back().position - leg.poses.front().position).norm() < kSamePlace)
    poses.pop_back();
  poses.insert(poses.end(), leg.poses.begin(), leg.poses.end());
}

// All but status, message, paths and what is told of the largest part.
void addNumbers(Plan& sum, const Plan& leg) {
  sum.cost += leg.cost;
  sum.segment_cost += leg.segment_cost;
  sum.optimal = sum.optimal && leg.optimal;
  sum.length_m += leg.length_m;
  sum.sharp_corners += leg.sharp_corners;
  sum.cells += leg.cells - 1;  // its first is the last of the leg before
  sum.statistics += leg.statistics;
  sum.preparation_time_s += leg.preparation_time_s;
  sum.expanded.insert(sum.expanded.end(), leg.expanded.begin(), leg.expanded.end());
}

// A place where legs end: a via-point, or the goal.
struct LegEnd {
  Pose pose;
  std::string name;
  bool passed = false;  // with any heading
};

class ViaPlanning {
 public:
  ViaPlanning(PathPlanner& planner, const ViaRequest& request, const StopSource& stop)
      : planner_(planner),
        request_(request),
        stop_(stop),
        options_(planner.options()),
        limited_(options_.timeout > 0.0),
        end_(StopToken::Clock::now() +
             std::chrono::duration_cast<StopToken::Clock::duration>(std::chrono::duration<double>(
                 options_.timeout * static_cast<double>(request.via.size() + 1)))) {}
  ~ViaPlanning() { planner_.setOptions(options_); }
  ViaPlanning(const ViaPlanning&) = delete;
  ViaPlanning& operator=(const ViaPlanning&) = delete;

  ViaPlan find() {
    std::vector<std::size_t> order(request_.via.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    if (request_.order == ViaOrder::BEST) {
      const std::optional<VisitingOrder> best = findOrder();
      if (!best) return std::move(answer_);
      order = best->order;
      answer_.order_exact = best->exact;
    }
    planInOrder(order);
    return std::move(answer_);
  }

 private:
  void planInOrder(const std::vector<std::size_t>& order) {
    Plan joined;
    std::size_t longest = 0;
    Pose from = request_.start;
    for (std::size_t leg = 0; leg <= order.size(); ++leg) {
      const LegEnd to = leg < order.size() ? viaPoint(order[leg]) : goal();
      Plan plan = planLeg(from, to, request_.record_expanded);
      if (!plan.found()) {
        if (leg < order.size() && isOfGoal(plan.status)) answer_.unreachable = {order[leg]};
        return fail(std::move(plan), to.name);
      }
      from = endOf(plan, to, from.yaw);
      if (plan.cells >= longest) {
        longest = plan.cells;
        joined.answered_by = plan.answered_by;
        joined.kernel = plan.kernel;
      }
      addLeg(joined, plan, to.name);
      if (bytesOf(joined) > memoryLimitOf(planner_.options().search))
        return fail(failedPlan(Status::INVALID_REQUEST, "the path takes more than memory_limit"),
                    to.name);
    }
    complete(joined, order);
  }

  void addLeg(Plan& joined, const Plan& leg, const std::string& name) {
    if (joined.path.empty()) {
      joined.status = Status::FOUND;
      joined.optimal = true;
      joined.cells = 1;
    }
    addNumbers(joined, leg);
    append(joined.path, leg.path);
    append(joined.waypoints, leg.waypoints);
    const std::string notes = notesOf(leg.message);
    if (!notes.empty()) addNote(notes_, "to " + name + ": " + notes);
  }

  void complete(Plan& joined, const std::vector<std::size_t>& order) {
    std::ostringstream text;
    text.precision(10);
    text << "a path of " << metresText(joined.length_m) << " through " << order.size()
         << (order.size() == 1 ? " via-point" : " via-points") << ", cost " << joined.costValue();
    joined.message = text.str();
    if (request_.order == ViaOrder::BEST) addNote(joined.message, orderNote(order));
    addNote(joined.message, notes_);
    // Of another order a path may cost less.
    if (request_.order == ViaOrder::BEST) joined.optimal = joined.optimal && answer_.order_exact;
    for (Path* path : {&joined.path, &joined.waypoints})
      applyHeadings(*path, request_.start.yaw, goalYaw(*path), options_.heading);
    const std::string contact = contactOn(joined.path);
    if (!contact.empty()) return fail(failedPlan(Status::UNREACHABLE, contact), "the goal");
    if (!contactOn(joined.waypoints).empty()) joined.waypoints = joined.path;
    answer_.plan = std::move(joined);
    answer_.order = order;
  }

  double goalYaw(const Path& path) const {
    return request_.any_goal_heading ? path::arrivalYaw(path, request_.start.yaw, options_.heading)
                                     : request_.goal.yaw;
  }

  // The headings of the joined path need not be those of its legs.
  std::string contactOn(const Path& path) {
    return planner_.footprintContact(path, request_.start.yaw, stop_.token());
  }

  std::string orderNote(const std::vector<std::size_t>& order) const {
    std::string text = "in the order";
    for (std::size_t i = 0; i < order.size(); ++i)
      text += (i == 0 ? " " : ", ") + std::to_string(order[i] + 1);
    return text + (answer_.order_exact ? ", and none costs less"
                                       : ", found by a heuristic: another may cost less");
  }

  void fail(Plan plan, const std::string& where) {
    answer_.order_exact = false;
    if (plan.status != Status::CANCELLED) plan.message = "to " + where + ": " + plan.message;
    answer_.plan = std::move(plan);
  }

  // None where something has no path: the answer says so.
  std::optional<VisitingOrder> findOrder() {
    if (!reachAll()) return std::nullopt;
    const std::size_t count = request_.via.size();
    LegCosts costs(count);
    for (std::size_t i = 0; i < count; ++i) costs.at(costs.start(), costs.via(i)) = from_start_[i];
    for (std::size_t from = 0; from < count; ++from) {
      for (std::size_t to = 0; to < count; ++to)
        if (from != to && !measure(costs, from, costs.via(to), viaPoint(to))) return std::nullopt;
      if (!measure(costs, from, costs.goal(), goal())) return std::nullopt;
    }
    return bestVisitingOrder(costs, limited_
                                        ? stop_.token(std::chrono::duration<double>(secondsLeft()))
                                        : stop_.token());
  }

  // From the start to each via-point: where they are reached, at which cost. All that are not are named.
  bool reachAll() {
    Plan first;
    PoseRequest leg;  // that it answers
    for (std::size_t i = 0; i < request_.via.size(); ++i) {
      const LegEnd to = viaPoint(i);
      Plan plan = planLeg(request_.start, to, false);
      if (plan.found()) {
        reached_.push_back(endOf(plan, to, request_.start.yaw));
        from_start_.push_back(plan.costValue());
        continue;
      }
      if (!isOfGoal(plan.status)) {
        fail(std::move(plan), to.name);
        return false;
      }
      if (answer_.unreachable.empty()) {
        first = std::move(plan);
        leg = answer_.last_leg;
      }
      answer_.unreachable.push_back(i);
    }
    if (answer_.unreachable.empty()) return true;
    answer_.last_leg = leg;
    fail(std::move(first), viaNames(answer_.unreachable));
    return false;
  }

  bool measure(LegCosts& costs, std::size_t from, std::size_t place, const LegEnd& to) {
    Plan plan = planLeg(reached_[from], to, false);
    if (!plan.found()) {
      fail(std::move(plan), to.name + " from " + viaName(from));
      return false;
    }
    costs.at(costs.via(from), place) = plan.costValue();
    return true;
  }

  Plan planLeg(const Pose& from, const LegEnd& to, bool record_expanded) {
    if (stop_.cancelled()) return failedPlan(Status::CANCELLED, "planning was cancelled");
    answer_.last_leg = {from, to.pose, record_expanded, to.passed};
    if (limited_) {
      PlannerOptions options = options_;
      options.timeout = std::min(options.timeout, secondsLeft());
      if (options.timeout <= 0.0) return failedPlan(Status::TIMEOUT, timeoutText());
      planner_.setOptions(options);
    }
    Plan plan = planner_.plan(answer_.last_leg, stop_);
    if (plan.status == Status::TIMEOUT) plan.message = timeoutText();
    return plan;
  }

  double secondsLeft() const {
    return std::chrono::duration<double>(end_ - StopToken::Clock::now()).count();
  }

  std::string timeoutText() const {
    std::ostringstream text;
    text << "planning reached its time limit of " << options_.timeout << " s a leg";
    return text.str();
  }

  // Within the tolerance it may be beside the point. The z is the point's, whatever path_z makes of it.
  // A vehicle that cannot turn freely goes on with the heading that it came with.
  Pose endOf(const Plan& plan, const LegEnd& to, double start_yaw) const {
    Pose end = plan.path.poses.back();
    end.position.z() = to.pose.position.z();
    if (options_.footprint.empty() && options_.min_turning_radius <= 0.0) return end;
    const vehicle::Motion last =
        path::motionsAlong(plan.path, start_yaw, std::nullopt, options_.heading).back();
    end.yaw = last.yaw + last.turn;
    return end;
  }

  LegEnd viaPoint(std::size_t index) const {
    Pose pose;
    pose.position = request_.via[index];
    return {pose, viaName(index), true};
  }
  LegEnd goal() const { return {request_.goal, "the goal", request_.any_goal_heading}; }

  PathPlanner& planner_;
  const ViaRequest& request_;
  const StopSource& stop_;
  const PlannerOptions options_;
  const bool limited_;
  const StopToken::Clock::time_point end_;  // where it is limited
  std::vector<Pose> reached_;               // via-points, from the start
  std::vector<double> from_start_;          // costs
  std::string notes_;
  ViaPlan answer_;
};

void lookAsItArrives(Plan& plan, const ViaRequest& request, path::HeadingMode mode) {
  if (!plan.found()) return;
  for (Path* path : {&plan.path, &plan.waypoints})
    applyHeadings(*path, request.start.yaw, path::arrivalYaw(*path, request.start.yaw, mode), mode);
}

std::string complaintOf(const ViaRequest& request) {
  const std::size_t most = request.order == ViaOrder::BEST ? kMostOrdered : kMostVia;
  if (request.via.size() > most)
    return "there are " + std::to_string(request.via.size()) + " via-points, and at most " +
           std::to_string(most) +
           (request.order == ViaOrder::BEST ? " can be brought into the best order"
                                            : " can be visited");
  for (std::size_t i = 0; i < request.via.size(); ++i)
    if (!request.via[i].allFinite()) return viaName(i) + " must be finite numbers";
  return "";
}

}  // namespace

ViaPlan planThrough(PathPlanner& planner, const ViaRequest& request, const StopSource& stop) {
  ViaPlan answer;
  if (request.via.empty()) {
    answer.last_leg = {request.start, request.goal, request.record_expanded,
                       request.any_goal_heading};
    answer.plan = planner.plan(answer.last_leg, stop);
    if (request.any_goal_heading) lookAsItArrives(answer.plan, request, planner.options().heading);
    return answer;
  }
  const std::string complaint = complaintOf(request);
  if (!complaint.empty()) {
    answer.plan = failedPlan(Status::INVALID_REQUEST, complaint);
    return answer;
  }
  try {
    return ViaPlanning(planner, request, stop).find();
  } catch (const Stopped& stopped) {
    answer.plan =
        failedPlan(stopped.status(), stopped.status() == Status::TIMEOUT
                                         ? "the search for the best order reached its time limit"
                                         : "planning was cancelled");
  }
  return answer;
}

}  // namespace grid_path_planner::planning
