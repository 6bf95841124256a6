#include "grid_path_planner/planning/unused_options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <sstream>

#include "grid_path_planner/base/option_text.h"

namespace grid_path_planner::planning {

using base::InputError;
using base::OptionInfo;
using base::parseOption;
using base::Status;
using base::StopToken;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Pose;
using planners::plannerNames;

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

PlannerOptions optionsWith(const Settings& settings) {
  PlannerOptions options;
  for (const auto& setting : settings)
    visitOptions(options, [&](const char* name, auto& value, const OptionInfo& info) {
      if (setting.first == name) parseOption(name, setting.second, info, value);
    });
  checkPlannerOptions(options);
  return options;
}

// "option: what leaves it without effect", for each.
std::vector<std::string> unusedWith(const Settings& settings) {
  std::vector<std::string> lines;
  for (const UnusedOption& each : unusedOptions(optionsWith(settings)))
    lines.push_back(each.name + ": " + each.with);
  return lines;
}

using Lines = std::vector<std::string>;

TEST(UnusedOptions, DefaultsAreNeverUnused) {
  for (const std::string& planner : plannerNames())
    EXPECT_EQ(unusedWith({{"planner", planner}}), Lines()) << planner;
}

// A program whose own default differs warned its users of an option that they had not touched.
TEST(UnusedOptions, OptionsAtTheDefaultsThatAreGivenAreNeverUnused) {
  const PlannerOptions options = optionsWith({{"planner", "anya"}, {"smooth", "false"}});
  EXPECT_EQ(unusedOptions(options, options), std::vector<UnusedOption>());
  EXPECT_EQ(unusedOptions(options).size(), 1U);
}

TEST(UnusedOptions, WhatThePlannerDoesNotLookAt) {
  EXPECT_EQ(unusedWith({{"planner", "jump_point"}, {"heuristic", "zero"}, {"landmarks", "4"}}),
            (Lines{"heuristic: planner jump_point", "landmarks: planner jump_point"}));
  EXPECT_EQ(unusedWith({{"planner", "dijkstra"}, {"tie_break", "larger_g"}}), Lines());
  EXPECT_EQ(unusedWith({{"planner", "dijkstra"}, {"memory_limit", "100"}}), Lines());
  EXPECT_EQ(unusedWith({{"rectangle_funnel", "false"}}),
            (Lines{"rectangle_funnel: planner weighted_jump_point"}));
}

TEST(UnusedOptions, WhatTheHeuristicDoesNotLookAt) {
  EXPECT_EQ(unusedWith({{"landmarks", "4"}, {"planner", "a_star"}}),
            (Lines{"landmarks: heuristic octile"}));
  EXPECT_EQ(unusedWith({{"landmarks", "4"}, {"heuristic", "zero"}}),
            (Lines{"landmarks: heuristic zero"}));
  EXPECT_EQ(unusedWith({{"landmarks", "4"}}), Lines());  // of paid ones
  EXPECT_EQ(unusedWith({{"landmarks", "4"}, {"heuristic", "landmark"}}), Lines());
  EXPECT_EQ(unusedWith({{"heuristic", "zero"}, {"epsilon", "2"}, {"heuristic_scale", "3"}}),
            (Lines{"heuristic_scale: heuristic zero", "epsilon: heuristic zero"}));
}

TEST(UnusedOptions, WhatTheCostmapLeavesWithoutEffect) {
  EXPECT_EQ(unusedWith({{"occupied_weight", "7"}}),
            (Lines{"occupied_weight: occupied_is_passable false"}));
  EXPECT_EQ(unusedWith({{"occupied_weight", "7"}, {"occupied_is_passable", "true"}}), Lines());
  EXPECT_EQ(unusedWith({{"unknown_weight", "7"}}), Lines());
  EXPECT_EQ(unusedWith({{"unknown_weight", "7"}, {"unknown_is_passable", "false"}}),
            (Lines{"unknown_weight: unknown_is_passable false"}));
  EXPECT_EQ(unusedWith({{"radius", "1"}, {"inflation_weight", "7"}}),
            (Lines{"inflation_weight: decay 0"}));
  EXPECT_EQ(unusedWith({{"decay", "1"}, {"inflation_weight", "7"}}), Lines());
  EXPECT_EQ(unusedWith({{"kernel_rule", "filter2d"}, {"retry_finer", "false"}}),
            (Lines{"kernel_rule: kernel 1", "retry_finer: kernel 1"}));
  EXPECT_EQ(unusedWith({{"kernel_rule", "filter2d"}, {"retry_finer", "false"}, {"kernel", "2"}}),
            Lines());
  EXPECT_EQ(unusedWith({{"connectivity", "4"}, {"cut_corners", "true"}, {"diagonal_cost", "unit"}}),
            (Lines{"diagonal_cost: connectivity 4", "cut_corners: connectivity 4"}));
}

TEST(UnusedOptions, WhatThePathLeavesWithoutEffect) {
  for (const char* planner : {"anya", "polyanya"})
    EXPECT_EQ(unusedWith({{"planner", planner}, {"smooth", "false"}}),
              (Lines{std::string("smooth: planner ") + planner}));
  for (const char* planner : {"lazy_theta_star", "rectangle_map", "a_star"})
    EXPECT_EQ(unusedWith({{"planner", planner}, {"smooth", "false"}}), Lines()) << planner;
  EXPECT_EQ(unusedWith({{"planner", "anya"}, {"smooth", "false"}, {"kernel", "2"}}), Lines())
      << "the legs out of blocked blocks are paths over the grid";
  EXPECT_EQ(unusedWith({{"smooth", "false"}, {"connectivity", "4"}}),
            (Lines{"smooth: connectivity 4"}));
  EXPECT_EQ(unusedWith({{"smooth", "false"}, {"diagonal_cost", "unit"}}),
            (Lines{"smooth: diagonal_cost unit"}));
  EXPECT_EQ(unusedWith({{"fixed_z", "2"}}), (Lines{"fixed_z: path_z interpolate"}));
  EXPECT_EQ(unusedWith({{"fixed_z", "2"}, {"path_z", "fixed"}}), Lines());
}

// ---- The law: no path differs if an option that is named has its default.

// Values other than the defaults, any of which go together unless checkPlannerOptions() says no.
const std::vector<std::pair<std::string, std::vector<std::string>>> kValues = {
    {"planner", plannerNames()},
    {"heuristic", {"zero", "landmark"}},
    {"heuristic_scale", {"0.5", "3"}},
    {"epsilon", {"2"}},
    {"tie_break", {"larger_g"}},
    {"landmarks", {"3"}},
    {"rectangle_weight", {"area"}},
    {"rectangle_funnel", {"false"}},
    {"unknown_weight", {"1", "7"}},
    {"occupied_weight", {"3"}},
    {"unknown_is_passable", {"false"}},
    {"occupied_is_passable", {"true"}},
    {"decay", {"0.7"}},
    {"inflation_weight", {"9"}},
    {"kernel", {"2"}},
    {"kernel_rule", {"filter2d"}},
    {"connectivity", {"4"}},
    {"diagonal_cost", {"unit"}},
    {"cut_corners", {"true"}},
    {"retry_finer", {"false"}},
    {"smooth", {"false"}},
    {"path_z", {"start", "fixed"}},
    {"fixed_z", {"1.5"}},
};

Settings randomSettings(std::mt19937& random) {
  Settings settings;
  for (const auto& option : kValues)
    if (random() % 3 == 0)
      settings.emplace_back(option.first, option.second[random() % option.second.size()]);
  return settings;
}

PlannerOptions withDefault(const std::string& option, PlannerOptions options) {
  PlannerOptions defaults;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo&) {
    if (option != name) return;
    visitOptions(defaults, [&](const char* other, auto& its_default, const OptionInfo&) {
      if constexpr (std::is_same_v<decltype(value), decltype(its_default)>)
        if (option == other) value = its_default;
    });
  });
  return options;
}

Plan reportOf(const PlannerOptions& options, const std::shared_ptr<const OccupancyGrid>& map,
              const PoseRequest& request) {
  PathPlanner planner(options);
  planner.setMap(map);
  planner.finishPreparation(StopToken());
  return planner.plan(request);
}

// To the last digit. Not whether it is called optimal: the planners do not look that closely.
std::string told(const Plan& report) {
  std::ostringstream out;
  out.precision(17);
  out << toString(report.status) << ' ' << report.message << ' ' << report.costValue() << ' '
      << report.kernel;
  for (const Pose& pose : report.path.poses)
    out << '\n' << pose.position.transpose() << ' ' << pose.yaw;
  return out.str();
}

TEST(UnusedOptions, ChangeNoPath) {
  std::mt19937 random(20261121);
  int compared = 0, found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    PlannerOptions options;
    const Settings settings = randomSettings(random);
    try {
      options = optionsWith(settings);
    } catch (const InputError&) {
      continue;  // they contradict each other
    }
    const std::vector<UnusedOption> unused = unusedOptions(options);
    if (unused.empty()) continue;
    const auto map = std::make_shared<OccupancyGrid>(GridGeometry(15, 11, 1.0));
    for (std::int8_t& value : map->values())
      value = random() % 5 == 0 ? 100 : random() % 4 == 0 ? -1 : 0;
    PoseRequest request;
    request.start.position << random() % 15 + 0.5, random() % 11 + 0.5, 3.0;
    request.goal.position << random() % 15 + 0.5, random() % 11 + 0.5, 5.0;
    const Plan report = reportOf(options, map, request);
    found += report.status == Status::FOUND ? 1 : 0;
    for (const UnusedOption& each : unused) {
      const Plan other = reportOf(withDefault(each.name, options), map, request);
      EXPECT_EQ(told(other), told(report)) << each.name << " with " << each.with;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace grid_path_planner::planning
