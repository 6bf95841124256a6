// What the action and the services of path_planner are asked, beside ~make_plan.
#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "planning/explanation.h"
#include "ros/planning/requests/request_messages.h"
#include "ros/planning/requests/request_poses.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr std::size_t kMostVisited = 5;          // of which the order is searched for
constexpr std::size_t kMostQuestionsAsked = 20;  // of a comparison

geometry_msgs::PoseStamped placeAt(double x, double y) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1.0;
  return pose;
}

// Two rooms, and a third that nothing leads to.
std::shared_ptr<const grid::OccupancyGrid> mapWithRooms() {
  static const auto map = [] {
    auto made = std::make_shared<grid::OccupancyGrid>(grid::GridGeometry(10, 6, 1.0), 0);
    for (int row = 0; row < 6; ++row) (*made)[{7, row}] = 100;
    for (int row = 0; row < 5; ++row) (*made)[{3, row}] = 100;
    return made;
  }();
  return map;
}

// tf knows nothing: poses are in the map, or nowhere.
struct AskedPlan {
  nodes::PlanningRequest request;
  planning::PlannerOptions options;
  planning::ViaRequest poses;
};

AskedPlan askedPlan(const nodes::PlanningRequest& request) {
  static const nodes::FrameLookup transforms;
  nodes::PathPlannerNodeOptions options;
  options.tf_timeout = 0.0;
  nodes::checkText(request);
  return {request, nodes::optionsFor(request, options),
          nodes::posesOf(request, options, transforms, "map", {})};
}

// As PlanningLane does it.
template <class Use>
void withPoses(const nodes::PlanningRequest& request, const Use& use) {
  setTime(ros::Time(1000, 0));
  try {
    const AskedPlan asked = askedPlan(request);
    planning::PathPlanner planner(asked.options);
    planner.setMap(mapWithRooms());
    use(planner, asked);
  } catch (const base::InputError&) {
  } catch (const nodes::TransformError&) {
  }
  nodes::checkText(nodes::printable([&] {
    nodes::PlanningRequest told;  // what an answer repeats
    told.goal = request.goal;
    told.planner = request.planner;
    return told;
  }()));
}

std::vector<std::string> seedsOfPlanGoals() {
  PlanPathGoal goal;
  goal.start = placeAt(0.5, 0.5);
  goal.goal = placeAt(5.5, 0.5);
  goal.via_points = {placeAt(1.5, 4.5), placeAt(4.5, 4.5)};
  goal.order = "best";
  PlanPathGoal trip = goal;
  trip.goal = {};
  trip.closed = 1;
  trip.planner = "a_star";
  PlanPathGoal far;
  far.goal = placeAt(9.5, 0.5);
  far.tolerance_m = 3.0;
  return {bytesOf(goal), bytesOf(trip), bytesOf(far)};
}

FUZZ_TARGET(plan_path_goal, seedsOfPlanGoals) {
  const auto goal = messageOf<PlanPathGoal>(input);
  if (!goal) return;
  withPoses(nodes::requestOf(*goal), [](planning::PathPlanner& planner, const AskedPlan& asked) {
    if (asked.poses.via.size() > kMostVisited) return;
    const planning::ViaPlan answer = planning::planThrough(planner, asked.poses);
    mustHold(answer.plan.found() == !answer.plan.path.poses.empty(),
             "a path is one that was found");
    mustHold(answer.order.size() == (answer.plan.found() ? asked.poses.via.size() : 0),
             "every via-point is passed once");
    for (const std::size_t index : answer.unreachable)
      mustHold(index < asked.poses.via.size(), "it is one of the via-points");
  });
}

std::vector<std::string> seedsOfExplanations() {
  ExplainPlan::Request request;
  request.start = placeAt(0.5, 0.5);
  request.goal = placeAt(9.5, 0.5);
  ExplainPlan::Request occupied = request;
  occupied.goal = placeAt(7.5, 3.5);
  return {bytesOf(request), bytesOf(occupied)};
}

FUZZ_TARGET(explain_request, seedsOfExplanations) {
  const auto request = messageOf<ExplainPlan::Request>(input);
  if (!request) return;
  withPoses(nodes::requestOf(*request), [](planning::PathPlanner& planner, const AskedPlan& asked) {
    const planning::PoseRequest poses{asked.poses.start, asked.poses.goal, false};
    const planning::Plan plan = planner.plan(poses);
    const auto explained = planning::explainFailure(planner, poses, plan.status, {});
    mustHold(!explained.gap || (explained.gap->position.allFinite() && explained.gap->width >= 0.0),
             "a gap is somewhere");
    mustHold(!explained.nearest || explained.nearest->allFinite(), "a place is somewhere");
  });
}

std::vector<std::string> seedsOfComparisons() {
  ComparePlans::Request all;
  all.start = placeAt(0.5, 0.5);
  all.goal = placeAt(5.5, 0.5);
  ComparePlans::Request some = all;
  some.planners = {"a_star", "dijkstra", "none"};
  some.heuristics = {"octile", "exact"};
  return {bytesOf(all), bytesOf(some)};
}

FUZZ_TARGET(compare_plans_request, seedsOfComparisons) {
  const auto compared = messageOf<ComparePlans::Request>(input);
  if (!compared) return;
  const auto requests = nodes::requestsOf(*compared);
  mustHold(requests.size() <= nodes::kMostQuestions + 1,
           "no more is made than is needed to refuse it");
  for (std::size_t i = 0; i < std::min(requests.size(), kMostQuestionsAsked); ++i)
    mayRefuse([&] {
      nodes::checkText(requests[i]);
      nodes::optionsFor(requests[i], {});
    });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
