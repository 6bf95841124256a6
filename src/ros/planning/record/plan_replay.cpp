#include "ros/planning/record/plan_replay.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>

#include "grid/map_differences.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/planners/planner_factory.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Status;
using base::StopToken;
using grid::differences;
using grid::OccupancyGrid;
using path::Path;
using planners::Heuristic;
using planners::plannerNames;
using planners::traitsOf;
using planning::failedPlan;
using planning::PathPlanner;
using planning::Plan;
using planning::PlannerOptions;
using planning::planThrough;

namespace {

using Map = std::shared_ptr<const OccupancyGrid>;

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty()) return a.empty() && b.empty();
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool sameAnswer(const PlanRecord& a, const PlanRecord& b) {
  return a.status == b.status && sameBits({a.cost}, {b.cost}) && sameBits(a.poses, b.poses);
}

// How fast the machine is shall not matter.
PlannerOptions unlimited(PlannerOptions options) {
  options.timeout = 0.0;
  return options;
}

// By a planner that has planned before, on a map that may follow from the one before.
Plan planNext(PathPlanner& planner, const PlanQuestion& question, const Map& map) {
  planner.setOptions(unlimited(question.options));
  if (planner.hasMap() && planner.map()->geometry() == map->geometry())
    planner.updateMap(map, differences(*planner.map(), map->values()));
  else
    planner.setMap(map);
  return planThrough(planner, question.request).plan;
}

enum class Preparation { ALL, NONE };

Plan planAnew(const PlanQuestion& question, const Map& map, Preparation preparation) {
  PathPlanner planner(unlimited(question.options));
  planner.setMap(map);
  if (preparation == Preparation::ALL) planner.finishPreparation(StopToken());
  return planThrough(planner, question.request).plan;
}

// That of the planner which answered, with a heuristic that the one that was asked gives it.
PlanQuestion askedDirectly(PlanQuestion question, const std::string& planner, Heuristic heuristic) {
  question.options.planner = planner;
  question.options.search.heuristic = heuristic;
  return question;
}

std::string poseText(const std::vector<double>& poses, std::size_t pose) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < 4; ++i) text << (i == 0 ? "(" : ", ") << poses[4 * pose + i];
  return text.str() + ")";
}

std::string posesText(std::size_t numbers) {
  return std::to_string(numbers / 4) + " poses";
}

// Where `now` is another answer than `then`.
std::string differenceText(const PlanRecord& then, const PlanRecord& now) {
  if (now.status != then.status)
    return now.status + " (" + now.message + ") instead of " + then.status;
  std::ostringstream text;
  text.precision(17);
  if (sameBits({now.cost}, {then.cost}))
    text << "another path of the same cost";
  else
    text << "cost " << now.cost << " instead of " << then.cost;
  const std::size_t most = std::min(now.poses.size(), then.poses.size()) / 4;
  std::size_t pose = 0;
  while (pose < most && std::memcmp(&now.poses[4 * pose], &then.poses[4 * pose], 32) == 0) ++pose;
  if (pose < most)
    text << "; pose " << pose + 1 << " is " << poseText(now.poses, pose) << " instead of "
         << poseText(then.poses, pose);
  else if (now.poses.size() != then.poses.size())
    text << "; " << posesText(now.poses.size()) << " instead of " << posesText(then.poses.size());
  return text.str();
}

// Why the same planner may have answered otherwise.
std::string reasonText(const PlanRecord& record, const PlanQuestion& question) {
  if (record.version != packageVersion())
    return "; it was recorded by version " + record.version + ", and this is " + packageVersion();
  for (const std::string& planner : plannerNames())
    if (traitsOf(planner).incremental &&
        (planner == question.options.planner || planner == record.answered_by))
      return "; " + planner +
             " repairs what the plans and maps before left, and not all of these are recorded";
  return "";
}

struct Attempt {
  std::string how;  // for the end of a sentence
  std::function<Plan()> plan;
};

// With what may have been prepared, by whoever answered.
std::vector<Attempt> attemptsOf(const PlanQuestion& question, const PlanRecord& record,
                                const Map& map) {
  std::vector<Attempt> attempts = {
      {"", [=] { return planAnew(question, map, Preparation::ALL); }},
      {", with nothing prepared", [=] { return planAnew(question, map, Preparation::NONE); }}};
  const std::string& answered_by = record.answered_by;
  if (answered_by.empty() || answered_by == question.options.planner) return attempts;
  for (const Heuristic heuristic : {question.options.search.heuristic, Heuristic::BLOCKS,
                                    Heuristic::MANHATTAN, Heuristic::CHEBYSHEV}) {
    const PlanQuestion direct = askedDirectly(question, answered_by, heuristic);
    attempts.push_back({" in place of " + question.options.planner,
                        [=] { return planAnew(direct, map, Preparation::ALL); }});
  }
  return attempts;
}

// What cannot be planned is an answer: the next attempt may be right.
Plan planOf(const Attempt& attempt) {
  try {
    return attempt.plan();
  } catch (const InputError& error) {
    return failedPlan(Status::INVALID_REQUEST, error.what());
  }
}

// Text of a bag, for a terminal.
std::string withoutControls(std::string text) {
  for (char& letter : text)
    if (std::iscntrl(static_cast<unsigned char>(letter)) != 0) letter = '?';
  return text;
}

std::string identicalText(const PlanRecord& record, const std::string& how) {
  std::string text = "identical: " + record.status;
  if (!record.poses.empty()) text += ", " + posesText(record.poses.size());
  if (!record.answered_by.empty()) text += ", by " + record.answered_by + how;
  return text;
}

}  // namespace

std::string PlanReplay::reasonAgainst(const PlanRecord& record) const {
  if (record.status == toString(Status::TIMEOUT))
    return "its time limit ended it, which depends on the machine";
  if (maps_.count(record.map_checksum) == 0)
    return "its map is not in the bag, on " + record.map_topic + " and " + record.updates_topic;
  return "";
}

ReplayedPlan PlanReplay::again(std::size_t index) {
  const PlanRecord& record = records_[index];
  ReplayedPlan result;
  try {
    const std::string against = reasonAgainst(record);
    if (!against.empty()) throw InputError(against);
    result = plannedAgain(index, questionOf(record));
  } catch (const InputError& error) {
    result.text = std::string("cannot be repeated: ") + error.what();
  }
  result.text = withoutControls(std::move(result.text));
  return result;
}

ReplayedPlan PlanReplay::plannedAgain(std::size_t index, const PlanQuestion& question) {
  const PlanRecord& record = records_[index];
  const Map map = maps_.at(record.map_checksum);
  std::vector<Attempt> attempts = attemptsOf(question, record, map);
  attempts.push_back({", after the plans before it", [&] { return withHistory(index); }});
  std::optional<ReplayedPlan> first;
  for (const Attempt& attempt : attempts) {
    Plan plan = planOf(attempt);
    const Path poses = posesAlong(plan, *map, question.pose_spacing, question.options.heading);
    const PlanRecord now = recordOf(question, *map, plan, poses);
    if (sameAnswer(record, now)) return {true, identicalText(record, attempt.how), std::move(plan)};
    if (!first)
      first = {false, "differs: " + differenceText(record, now) + reasonText(record, question),
               std::move(plan)};
  }
  return *std::move(first);
}

Plan PlanReplay::withHistory(std::size_t index) {
  History& history = records_[index].question ? of_questions_ : of_goals_;
  if (!history.planner || history.next > index) history = {std::make_unique<PathPlanner>(), 0};
  Plan last;
  for (; history.next <= index; ++history.next) {
    const PlanRecord& record = records_[history.next];
    const auto map = maps_.find(record.map_checksum);
    if (record.question != records_[index].question || map == maps_.end()) continue;
    try {
      last = planNext(*history.planner, questionOf(record), map->second);
    } catch (const InputError&) {
      continue;  // it is told of that one
    }
  }
  return last;
}

}  // namespace grid_path_planner::nodes
