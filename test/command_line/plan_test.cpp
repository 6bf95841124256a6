#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {

using grid::readMapFile;
using grid::writeImageFile;
using path::Path;
using path::readWaypointFile;

namespace {

using test::contains;

class Plan : public testing::Test {
 protected:
  Outcome plan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"plan", "--map", map_});
    return runCommand(runPlan, arguments);
  }

  const test::TemporaryFolder folder_;
  const std::string map_ = folder_.write("small.map",
                                         "type octile\nheight 3\nwidth 4\nmap\n"
                                         "....\n"
                                         ".@@.\n"
                                         "....\n");
};

TEST_F(Plan, PrintsOneObjectWithTheContractsFields) {
  const Outcome outcome = plan({"--cells", "--start", "0,0", "--goal", "3,2", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  const auto object = nlohmann::json::parse(outcome.printed);
  for (const char* field : {"status", "message", "cost", "length_m", "cells", "expanded",
                            "generated", "planning_time_ms", "search_bytes"})
    EXPECT_TRUE(object.contains(field)) << field;
  EXPECT_EQ(object["status"], "FOUND");
  EXPECT_EQ(object["cost"], 5.0);
  EXPECT_EQ(object["cells"], 3) << "the corners";
}

TEST_F(Plan, NoPathIsExitCodeOneAndHasItsReason) {
  const Outcome outcome = plan({"--cells", "--start", "1,1", "--goal", "3,2", "--json"});
  EXPECT_EQ(outcome.code, 1);
  const auto object = nlohmann::json::parse(outcome.printed);
  EXPECT_EQ(object["status"], "START_OCCUPIED");
  EXPECT_TRUE(object["cost"].is_null());
}

TEST_F(Plan, PassesViaPointsInTheBestOrder) {
  const std::vector<std::string> trip = {"--cells", "--start", "0,0",   "--closed", "--via",
                                         "3,2",     "3,0",     "--via", "0,2",      "--json"};
  const auto given = nlohmann::json::parse(plan(trip).printed);
  EXPECT_EQ(given["via_order"], (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(given["via_order_exact"], false);
  std::vector<std::string> ordered = trip;
  ordered.insert(ordered.end(), {"--order", "best"});
  const Outcome outcome = plan(ordered);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  const auto best = nlohmann::json::parse(outcome.printed);
  EXPECT_EQ(best["via_order_exact"], true);
  EXPECT_EQ(best["cost"], 10.0);
  EXPECT_GT(given["cost"], 10.0);
}

TEST_F(Plan, ViaPointsAreRefusedWithAReason) {
  const auto errorWith = [&](const std::vector<std::string>& arguments) {
    return plan(arguments).error;
  };
  EXPECT_TRUE(contains(errorWith({"--start", "0,0", "--goal", "1,1", "--via", "1"}),
                       "--via needs 2 to 3 numbers"));
  EXPECT_TRUE(contains(errorWith({"--start", "0,0", "--goal", "1,1", "--via", "1,1", "--closed"}),
                       "contradict"));
  EXPECT_TRUE(contains(errorWith({"--start", "0,0", "--closed"}), "--closed needs --via"));
  EXPECT_TRUE(contains(
      errorWith({"--start", "0,0", "--goal", "1,1", "--via", "1,1", "--order", "x"}), "--order"));
  const Outcome blocked =
      plan({"--cells", "--start", "0,0", "--goal", "3,0", "--via", "3,2", "1,1"});
  EXPECT_EQ(blocked.code, 1);
  EXPECT_TRUE(contains(blocked.printed, "GOAL_OCCUPIED: to via-point 2: ")) << blocked.printed;
}

TEST_F(Plan, SaysWhyThereIsNoPathWhereAsked) {
  const std::string map = folder_.write("door.map",
                                        "type octile\nheight 7\nwidth 9\nmap\n"
                                        "....@....\n"
                                        "....@....\n"
                                        ".........\n"
                                        ".........\n"
                                        ".........\n"
                                        "....@....\n"
                                        "....@....\n");
  const std::vector<std::string> question = {"plan",   "--map",   map,        "--start", "1.5,3.5",
                                             "--goal", "7.5,3.5", "--radius", "2"};
  const auto asked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), question.begin(), question.end());
    return runCommand(runPlan, more);
  };
  EXPECT_FALSE(contains(asked({}).printed, "would pass"));
  EXPECT_TRUE(contains(asked({"--explain"}).printed,
                       "the gap at (4.5, 3.5) is 3 m wide; radius 2 m needs 4 m; 1.5 m would pass"))
      << asked({"--explain"}).printed;
  const auto object = nlohmann::json::parse(asked({"--explain", "--json"}).printed);
  EXPECT_EQ(object["explanation"]["gap"]["largest_radius_m"], 1.5);
  EXPECT_EQ(object["explanation"]["only_unknown"], false);
}

TEST_F(Plan, NegativeNumbersParse) {
  const Outcome outside = plan({"--start", "-1.5,2", "--goal", "0.5,0.5"});
  EXPECT_EQ(outside.code, 1) << outside.error;
  EXPECT_TRUE(contains(outside.printed, "START_OUTSIDE_MAP")) << outside.printed;
  EXPECT_TRUE(contains(outside.printed, "(-1.5, 2)")) << outside.printed;
  EXPECT_EQ(plan({"--start=-1.5,2", "--goal=0.5,0.5"}).code, 1);
}

// As the parameters of the nodes and the messages spell them.
TEST_F(Plan, NamesOfOptionsMayHaveUnderscores) {
  EXPECT_EQ(plan({"--start", "0.5,0.5", "--goal=3.5,2.5", "--heuristic_scale", "1"}).code, 0);
  EXPECT_EQ(plan({"--start", "0.5,0.5", "--goal=3.5,2.5", "--heading=along_me"}).error,
            plan({"--start", "0.5,0.5", "--goal=3.5,2.5", "--heading", "along_me"}).error);
}

TEST_F(Plan, WritesPictureAndWaypoints) {
  const std::string picture = folder_.path("path.png");
  const std::string waypoints = folder_.path("waypoints.yaml");
  const Outcome outcome = plan({"--start", "0.5,0.5,3", "--goal", "3.5,2.5,5,1.5", "--image",
                                picture, "--waypoints", waypoints});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(test::contentOf(picture).substr(1, 3), "PNG");
  const Path path = readWaypointFile(waypoints).path;
  EXPECT_EQ(path.poses.front().position, Eigen::Vector3d(0.5, 0.5, 3.0));
  EXPECT_EQ(path.poses.back().position, Eigen::Vector3d(3.5, 2.5, 5.0));
  EXPECT_NEAR(path.poses.back().yaw, 1.5, 1e-8);
}

TEST_F(Plan, OptionsReachThePlanner) {
  const std::vector<std::string> ends = {"--cells", "--start", "0,0", "--goal", "3,2", "--json"};
  const auto costWith = [&](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    const Outcome outcome = plan(more);
    EXPECT_EQ(outcome.code, 0) << outcome.error << outcome.printed;
    return nlohmann::json::parse(outcome.printed)["cost"].get<double>();
  };
  EXPECT_EQ(costWith({"--weights", "3,50,100"}), 15.0);
  EXPECT_EQ(costWith({"--planner", "dijkstra", "--connectivity", "4"}), 5.0);
  EXPECT_EQ(
      costWith({"--occupied-is-passable", "true", "--weights", "1,1,1", "--diagonal-cost", "unit"}),
      3.0);
}

TEST_F(Plan, SaysWhetherThePathIsOptimal) {
  const auto optimalWith = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--cells", "--start", "0,0", "--goal", "3,2", "--json"});
    testing::internal::CaptureStderr();
    const Outcome outcome = plan(more);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    const std::string warning = testing::internal::GetCapturedStderr();
    const bool optimal = nlohmann::json::parse(outcome.printed)["optimal"];
    EXPECT_EQ(contains(warning, "may not be optimal"),
              more[2] == "--epsilon" || more[2] == "--heuristic")
        << warning;
    return optimal;
  };
  for (const char* smooth : {"true", "false"}) {
    const bool grid_path = std::string(smooth) == "false";
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"--smooth", smooth});
      return optimalWith(more);
    };
    EXPECT_EQ(with({}), grid_path);
    EXPECT_EQ(with({"--planner", "dijkstra"}), grid_path);
    EXPECT_FALSE(with({"--planner", "lazy_theta_star"}));
    EXPECT_FALSE(with({"--epsilon", "2"}));
    EXPECT_FALSE(with({"--heuristic", "manhattan"}));
  }
}

// The vehicle's YAML is written once: a radius that only the node knew made the command line's path
// another one.
TEST_F(Plan, TakesTheYamlOfTheNode) {
  const auto planWith = [&](const std::string& yaml, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--config", folder_.write("vehicle.yaml", yaml), "--cells", "--start",
                             "0,0", "--goal", "3,2", "--json"});
    return plan(more);
  };
  const auto costWith = [&](const std::string& yaml, std::vector<std::string> more = {}) {
    const Outcome outcome = planWith(yaml, more);
    EXPECT_EQ(outcome.code, 0) << outcome.error << outcome.printed;
    return nlohmann::json::parse(outcome.printed)["cost"].get<double>();
  };
  EXPECT_EQ(costWith("# nothing yet\n"), 5.0);
  EXPECT_EQ(costWith("free_weight: 3\nbase_frame: base_link  # of the node alone\n"), 15.0);
  EXPECT_EQ(costWith("free_weight: 3\n", {"--free-weight", "2"}), 10.0);
  EXPECT_EQ(costWith("free_weight: 3\n", {"--weights", "2,50,100"}), 10.0);
  EXPECT_EQ(planWith("radius: 0.6\n").code, 1);
  EXPECT_TRUE(contains(planWith("cut_corners: false\nradius: wide\n").error,
                       "vehicle.yaml:2: radius needs a finite number, got 'wide'"));
  EXPECT_TRUE(contains(planWith("retry_finer: perhaps\n").error, "vehicle.yaml:1: retry_finer"));
  EXPECT_TRUE(contains(planWith("- radius\n").error, "vehicle.yaml"));

  testing::internal::CaptureStderr();
  EXPECT_EQ(costWith("raduis: 0.6\n"), 5.0);
  const std::string warning = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(warning,
                       "vehicle.yaml:1: unknown parameter raduis is not used; did you "
                       "mean radius?"))
      << warning;
}

TEST_F(Plan, TakesTheDescriptionOfTheVehicle) {
  const std::string map = folder_.write("lane.map",
                                        "type octile\nheight 5\nwidth 9\nmap\n"
                                        "@@@@@@@@@\n"
                                        "@.......@\n"
                                        "@.......@\n"
                                        "@.......@\n"
                                        "@@@@@@@@@\n");
  const auto planWith = [&](const std::string& shape, std::vector<std::string> more = {}) {
    const std::string limits =
        ", max_speed: 1, max_yaw_rate: 1, max_acceleration: 1, max_yaw_acceleration: 1}\n";
    const std::string file =
        folder_.write("robot.yaml", "vehicle: {drive: differential, " + shape + limits);
    more.insert(more.begin(), {"plan", "--map", map, "--start", "2.5,2.5,0,0", "--goal",
                               "6.5,2.5,0,0", "--vehicle", file});
    return runCommand(runPlan, more);
  };
  EXPECT_EQ(planWith("radius: 1.4").code, 0) << planWith("radius: 1.4").error;
  EXPECT_EQ(planWith("radius: 1.6").code, 1);
  const std::string narrow = "outline: [[1.4, 1.2], [-1.4, 1.2], [-1.4, -1.2], [1.4, -1.2]]";
  EXPECT_EQ(planWith(narrow).code, 0) << planWith(narrow).printed;
  const std::string too_long = "outline: [[1.8, 1.2], [-1.8, 1.2], [-1.8, -1.2], [1.8, -1.2]]";
  EXPECT_TRUE(contains(planWith(too_long).printed, "the footprint meets")) << "1.5 m to the wall";
  EXPECT_TRUE(contains(planWith("radius: 1.4", {"--radius", "1"}).error, "radius is 1 m, less"));
  EXPECT_TRUE(contains(planWith("radios: 1.4").error, "robot.yaml:1: vehicle has no 'radios'"))
      << planWith("radios: 1.4").error;
}

// A file written as for move_base, below the node's name, was planned with radius 0, and the warning asked whether 'planner' was
// meant.
TEST_F(Plan, ParametersBelowTheNodesNameAreSeenAsSuch) {
  const std::string config = folder_.write("vehicle.yaml", "path_planner:\n  radius: 0.4\n");
  testing::internal::CaptureStderr();
  runCommand(runPlan, {"plan", "--map", map_, "--start", "0.05,0.05", "--goal", "0.35,0.25",
                       "--config", config});
  const std::string warning = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(warning,
                       "vehicle.yaml:1: unknown parameter path_planner is not used; radius stands "
                       "below it: leave the line "
                       "'path_planner:' out"))
      << warning;
}

// "is not text: byte 0".
TEST_F(Plan, AnOctreeIsNamedWithTheCommandThatProjectsIt) {
  const std::string tree =
      folder_.write("site.bt", std::string("# Octomap OcTree binary file\nid OcTree\n\0", 41));
  const auto outcome =
      runCommand(runPlan, {"plan", "--map", tree, "--start", "0,0", "--goal", "1,1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.error, "site.bt: is an octree, no map: grid_path project"))
      << outcome.error;
}

// An office of 20 m was planned on as one of 400 m.
TEST_F(Plan, AnImageAloneIsAskedForItsResolution) {
  const std::string image = folder_.path("office.png");
  writeImageFile(image, readMapFile(map_));
  const auto planOn = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"plan", "--map", image, "--start", "0.05,0.05", "--goal", "0.35,0.25"});
    return runCommand(runPlan, more);
  };
  EXPECT_TRUE(contains(planOn({}).error, "give it in metres, as in --resolution 0.05"))
      << planOn({}).error;
  EXPECT_EQ(planOn({"--resolution", "0.1"}).code, 0);
}

TEST_F(Plan, OptionsThatChangeNothingAreTold) {
  const auto warningsWith = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--start", "0.5,0.5", "--goal", "3.5,2.5"});
    testing::internal::CaptureStderr();
    EXPECT_EQ(plan(more).code, 0);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(warningsWith({"--planner", "jump_point", "--epsilon", "2"}),
            "warning: --epsilon changes nothing with planner jump_point\n");
  EXPECT_EQ(warningsWith({"--landmarks", "4", "--planner", "a_star"}),
            "warning: --landmarks changes nothing with heuristic octile\n");
  EXPECT_EQ(warningsWith({"--planner", "polyanya", "--smooth", "false"}),
            "warning: --smooth changes nothing with planner polyanya\n");
  EXPECT_EQ(warningsWith({"--landmarks", "4", "--heuristic", "landmark"}), "");
  EXPECT_EQ(warningsWith({"--planner", "rectangle_map", "--rectangle-weight", "area"}), "");
}

TEST_F(Plan, BadInputIsNamed) {
  const auto errorWith = [&](std::vector<std::string> arguments) {
    const Outcome outcome = plan(std::move(arguments));
    EXPECT_EQ(outcome.code, kBadInput) << outcome.printed;
    return outcome.error;
  };
  const std::vector<std::string> ends = {"--start", "0.5,0.5", "--goal", "3.5,0.5"};
  const auto with = [&ends](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    return more;
  };
  EXPECT_TRUE(contains(errorWith({"--start", "nan,1", "--goal", "1,1"}), "--start"));
  EXPECT_TRUE(contains(errorWith({"--start", "1", "--goal", "1,1"}), "--start"));
  EXPECT_TRUE(contains(errorWith({"--start", "1,x", "--goal", "1,1"}), "'x'"));
  EXPECT_TRUE(contains(errorWith({"--cells", "--start", "1.5,1", "--goal", "1,1"}), "whole"));
  EXPECT_TRUE(contains(errorWith({"--start", "1,1"}), "--goal is missing; usage: grid_path plan"));
  EXPECT_TRUE(contains(errorWith({}), "--start and --goal are missing"));
  EXPECT_EQ(errorWith(with({"--resolution", "-0.1"})),
            "--resolution must be a positive number of metres, got -0.1");
  EXPECT_TRUE(contains(errorWith(with({"--planner", "fastest"})), "a_star"));
  EXPECT_TRUE(contains(errorWith(with({"--heuristic", "best"})), "octile"));
  EXPECT_TRUE(contains(errorWith(with({"--kernel", "0"})), "kernel"));
  EXPECT_TRUE(contains(errorWith(with({"--kernel", "2.5"})), "kernel"));
  EXPECT_TRUE(contains(errorWith(with({"--weights", "0,1,2"})), "--weights"));
  EXPECT_TRUE(contains(errorWith(with({"--weights", "1,nan,2"})), "--weights"));
  EXPECT_TRUE(contains(errorWith(with({"--radius", "-1"})), "radius"));
  EXPECT_TRUE(contains(errorWith(with({"--no-such-option"})), "no-such-option"));
  EXPECT_EQ(errorWith(with({"--raduis", "1"})),
            "there is no option --raduis; did you mean --radius?");
  EXPECT_TRUE(contains(errorWith(with({"stray"})), "stray"));
  EXPECT_TRUE(contains(errorWith(with({"--waypoints", map_ + "/w.yaml"})), "w.yaml"));
  EXPECT_TRUE(contains(errorWith(with({"--image", map_ + "/p.png"})), "p.png"));
}

}  // namespace
}  // namespace grid_path_planner::command_line
