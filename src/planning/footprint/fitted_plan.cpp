#include "planning/footprint/fitted_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "path/motions.h"
#include "planning/message_text.h"
#include "planning/route.h"
#include "planning/turning/curves.h"
#include "planning/waypoints.h"

namespace grid_path_planner::planning {

using base::Status, base::StopToken;
using costmap::CostGrid, costmap::CostmapBuilder, costmap::SegmentRule;
using path::Path, path::Pose;
using vehicle::Footprint, vehicle::FootprintContact;

namespace {

// By which weights are raised where there is no room to turn, at the first tries.
constexpr int kFactors[] = {2, 10};
constexpr int kRaised = std::size(kFactors);
constexpr char kTryPlanner[] = "a_star";  // which takes any weights and prepares nothing

bool isAt(const Pose& pose, const Pose& place) {
  return (pose.position - place.position).head<2>().norm() < 1e-9;
}

// Where a goal may be passed with any heading none counts.
std::optional<double> headingAt(const Path& path, const PoseRequest& request) {
  return request.any_goal_heading ? std::nullopt : std::make_optional(path.poses.back().yaw);
}

PlannerOptions ofTries(PlannerOptions options) {
  options.planner = kTryPlanner;
  options.search = {};
  return options;
}

}  // namespace

FittedPlanner::FittedPlanner(const Footprint& footprint, const CostGrid& costs, Inflate inflate,
                             const PlannerOptions& options, std::size_t memory)
    : footprint_(footprint),
      costs_(costs),
      inflate_(std::move(inflate)),
      options_(options),
      memory_(memory),
      check_(footprint, costs, options),
      check_of_start_(footprint, costs, options) {
  terms_.priced = &costs_;
}

Plan FittedPlanner::plan(MultiResolutionPlanner& search, const PoseRequest& request,
                         const StopToken& stop) {
  std::vector<Pose> ends = {request.start};
  if (!request.any_goal_heading) ends.push_back(request.goal);
  check_.allowFor(ends);
  check_of_start_.allowFor({request.start});
  terms_.complaint = complaintAbout(request);
  if (options_.min_turning_radius > 0.0)
    terms_.shape = [this, &request, &stop](Plan& found) { bend(found, request, stop); };
  VehicleTerms first_terms = terms_;
  first_terms.priced = nullptr;
  Plan plan = planOnCosts(costs_, search, request, options_, stop, first_terms);
  if (!plan.found()) return plan;
  first_planner_ = plan.answered_by;
  if (contactsOf(plan, request, stop).empty())
    return completed(std::move(plan), request, "the footprint fits", stop);
  return planWithRoom(std::move(plan), request, stop);
}

void FittedPlanner::bend(Plan& plan, const PoseRequest& request, const StopToken& stop) const {
  const FootprintCheck& check = checkOf(plan.path, request);
  const auto fits = [&](const Path& path) {
    return !check.first(path, std::nullopt, std::nullopt, stop);
  };
  curvesFor(request, options_, costs_, fits, stop)(plan);
}

const FootprintCheck& FittedPlanner::checkOf(const Pose& end, const PoseRequest& request) const {
  return isAt(end, request.goal) ? check_ : check_of_start_;
}

std::function<std::string(const Pose&)> FittedPlanner::complaintAbout(
    const PoseRequest& request) const {
  return [this, request](const Pose& pose) {
    return (isAt(pose, request.start) ? check_ : checkOf(pose, request)).complaint(pose);
  };
}

FittedPlanner::Contacts FittedPlanner::contactsOf(const Plan& plan, const PoseRequest& request,
                                                  const StopToken& stop) const {
  return checkOf(plan.path, request)
      .contacts(plan.path, request.start.yaw, headingAt(plan.path, request), stop);
}

Plan FittedPlanner::planAnew(std::shared_ptr<const CostGrid> costs, const PoseRequest& request,
                             const VehicleTerms& terms, const PlannerOptions& options,
                             const StopToken& stop) {
  const PlannerOptions of_try = ofTries(options);
  MultiResolutionPlanner search(of_try.planner, of_try.search, planners::makePlanner);
  search.limitMemory(memory_ - bytesOfTries());
  search.prepare({costs, costs, {}, {}}, stop);
  Plan plan = planOnCosts(*costs, search, request, of_try, stop, terms);
  plan.optimal = false;
  plan.answered_by = first_planner_;
  spent_ += plan.statistics;
  plan.statistics = spent_;
  return plan;
}

std::size_t FittedPlanner::bytesOfTries() const {
  return 2 * CostmapBuilder::bytesFor(costs_.geometry(), 1);
}

// For a disc of the circumscribed radius.
std::shared_ptr<const CostGrid> FittedPlanner::turningCosts(const StopToken& stop) const {
  costmap::CostmapOptions options = options_.costmap;
  options.radius = std::max(options.radius, footprint_.circumscribedRadius());
  options.kernel = 1;
  return inflate_(options, stop);
}

// The pose on the straight line that leaves (sign 1) or reaches (-1) an end in its heading, where the vehicle can turn
// freely; the last one before an obstacle where there is none. None where the line is nothing.
std::optional<Pose> FittedPlanner::lead(const Pose& end, double sign,
                                        const CostGrid& turning) const {
  const std::optional<double> direction = path::drivingDirection(end.yaw, options_.heading);
  if (!direction) return std::nullopt;
  const grid::GridGeometry& geometry = costs_.geometry();
  const Eigen::Vector2d along(std::cos(*direction), std::sin(*direction));
  const double step = geometry.resolution(), longest = 4.0 * footprint_.circumscribedRadius();
  std::optional<Pose> lead;
  for (double length = step; length <= longest; length += step) {
    Pose pose = end;
    pose.position.head<2>() += sign * length * along;
    const std::optional<grid::Cell> cell = geometry.cellAt(pose.position.head<2>());
    if (!cell || !costs_.passable(*cell)) break;
    if (costs_.segmentRule() != SegmentRule::CENTRE_LATTICE &&
        !straightLineLegal(costs_, end.position.head<2>(), pose.position.head<2>()))
      break;
    lead = pose;
    if (turning.passable(*cell)) break;
  }
  return lead;
}

FittedPlanner::Question FittedPlanner::ledQuestion(const PoseRequest& request,
                                                   const CostGrid& turning) const {
  Question question{request, terms_};
  if (const auto first = lead(request.start, 1.0, turning)) {
    question.terms.from = request.start;
    question.request.start = *first;
  }
  const auto last = request.any_goal_heading ? std::nullopt : lead(request.goal, -1.0, turning);
  if (last) {
    question.terms.to = request.goal;
    question.request.goal = *last;
  }
  question.terms.complaint = complaintAbout(question.request);
  return question;
}

// Whether one was found, smoothed as asked for or, since only that is straight in doors, over the grid. `contacts` are those of
// the first path.
bool FittedPlanner::tryOn(const TryCosts& raised, const std::vector<Question>& questions,
                          Plan& plan, Contacts& contacts, const StopToken& stop) {
  ++tries_;
  contacts.clear();
  const std::shared_ptr<const CostGrid> costs = raised.costs();
  PlannerOptions options = options_;
  Plan first;
  do {
    for (const Question& question : questions) {
      // From another place than the one that leads to the goal, nobody has looked at the line to it.
      options.tolerance = question.terms.to ? 0.0 : options_.tolerance;
      plan = planAnew(costs, question.request, question.terms, options, stop);
      if (!plan.found()) continue;
      const Contacts of_plan = contactsOf(plan, questions.front().request, stop);
      if (of_plan.empty()) return true;
      if (!contacts.empty()) continue;
      contacts = of_plan;
      first = plan;
    }
  } while (std::exchange(options.smooth, false));
  plan = std::move(first);
  return false;
}

bool FittedPlanner::tryAgain(Plan& plan, const PoseRequest& request, const CostGrid& turning,
                             const StopToken& stop) {
  const Eigen::Vector2d goal = request.goal.position.head<2>();
  TryCosts raised(costs_, request.start.position.head<2>(), &goal);
  const double cell = costs_.geometry().resolution();
  const double widest = footprint_.circumscribedRadius() - footprint_.inscribedRadius();
  const std::vector<Question> questions = {{request, terms_}, ledQuestion(request, turning)};
  Contacts contacts;
  for (const int factor : kFactors) {
    raised.raise(turning, factor);
    if (tryOn(raised, questions, plan, contacts, stop)) return true;
  }
  while (!contacts.empty() && tries_ < kTries) {
    const double share = static_cast<double>(tries_ + 1 - kRaised) / (kTries - kRaised);
    if (!raised.close(plan.path, contacts, std::max(0.75 * cell, share * widest))) return false;
    if (tryOn(raised, questions, plan, contacts, stop)) return true;
  }
  return false;
}

Plan FittedPlanner::planWithRoom(Plan first, const PoseRequest& request, const StopToken& stop) {
  const FootprintContact contact = contactsOf(first, request, stop).front();
  spent_ = first.statistics;
  if (memory_ < bytesOfTries())
    return failed(first, request, contact, "memory_limit leaves no room to look for another path");
  const std::shared_ptr<const CostGrid> turning = turningCosts(stop);
  Plan plan;
  if (tryAgain(plan, request, *turning, stop))
    return completed(std::move(plan), request,
                     "the footprint fits, at try " + std::to_string(tries_ + 1) + ", by " +
                         kTryPlanner + " past narrow places",
                     stop);
  PlannerOptions wide = options_;
  wide.costmap.radius = std::max(wide.costmap.radius, footprint_.circumscribedRadius());
  const std::string of_radius = "the circumscribed radius of " + metresText(wide.costmap.radius);
  plan = planAnew(turning, request, terms_, wide, stop);
  if (plan.found() && contactsOf(plan, request, stop).empty())
    return completed(std::move(plan), request,
                     "the footprint fits, with " + of_radius + " kept from obstacles", stop);
  return failed(first, request, contact,
                std::to_string(tries_) + " more tries and " + of_radius +
                    " gave no other path on which it fits");
}

// With waypoints on the line of the path itself where the footprint does not fit on a shorter one.
Plan FittedPlanner::completed(Plan plan, const PoseRequest& request, const std::string& how,
                              const StopToken& stop) const {
  addNote(plan.message, how);
  const FootprintCheck& check = checkOf(plan.path, request);
  addNote(plan.message, check.note());
  if (check.first(plan.waypoints, request.start.yaw, headingAt(plan.waypoints, request), stop)) {
    PlannerOptions exact = options_;
    exact.waypoint_tolerance = 0.0;
    plan.waypoints = waypointsOf(plan.path, exact, costs_);
  }
  return plan;
}

Plan FittedPlanner::failed(const Plan& first, const PoseRequest& request,
                           const FootprintContact& contact, const std::string& tried) const {
  Plan plan = failedPlan(Status::UNREACHABLE,
                         unreachableText(request.start.position.head<2>(),
                                         request.goal.position.head<2>(), options_.tolerance) +
                             " for the footprint: on the best one for its inscribed radius of " +
                             metresText(footprint_.inscribedRadius()) + " " + check_.text(contact) +
                             "; " + tried);
  plan.answered_by = first.answered_by;
  plan.statistics = spent_;
  plan.expanded = first.expanded;
  return plan;
}

}  // namespace grid_path_planner::planning
