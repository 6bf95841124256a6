#include "ros/guard/parameters.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/String.h>

#include <limits>
#include <memory>

#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/mapping/projected_map_options.h"
#include "ros/planning/path_planner_options.h"
#include "ros/support/latest.h"

namespace grid_path_planner::nodes {

using base::InputError;
using costmap::checkCostmapOptions;
using costmap::Connectivity;
using mapping::ProjectedMapOptions;
using planners::Heuristic;

namespace {

using Options = PathPlannerNodeOptions;
using dynamic_reconfigure::ConfigTools;

std::string refusalOf(const ros::NodeHandle& nh) {
  Options options;
  options.planner.costmap.kernel = 7;
  try {
    loadParameters(nh, options);
  } catch (const InputError& error) {
    EXPECT_EQ(options.planner.costmap.kernel, 7) << "half loaded";
    return error.what();
  }
  return "";
}

TEST(Parameters, AreTakenByNameAndOthersKeepTheirValue) {
  Options options;
  loadParameters(ros::NodeHandle("/given"), options);
  EXPECT_EQ(options.planner.costmap.radius, 2.0);
  EXPECT_EQ(options.planner.costmap.motion.connectivity, Connectivity::FOUR);
  EXPECT_EQ(options.planner.search.heuristic_scale, "1.5");
  EXPECT_EQ(options.planner.search.heuristic, Heuristic::ZERO);
  EXPECT_EQ(options.planner.costmap.kernel, 3);
  EXPECT_EQ(options.planner.costmap.free_weight, 1);
}

TEST(Parameters, WrongTypesAreRefusedWithFullNameValueAndWhatWasExpected) {
  ros::NodeHandle nh("/wrong_type");
  nh.setParam("kernel", "three");
  EXPECT_EQ(refusalOf(nh), "/wrong_type/kernel must be an integer, got the string three");
  nh.setParam("kernel", 2.5);
  EXPECT_EQ(refusalOf(nh), "/wrong_type/kernel must be an integer, got the number 2.5");
  nh.deleteParam("kernel");
  nh.setParam("unknown_is_passable", 1);
  EXPECT_EQ(refusalOf(nh),
            "/wrong_type/unknown_is_passable must be true or false, got the integer 1");
  nh.deleteParam("unknown_is_passable");
  nh.setParam("radius", true);
  EXPECT_EQ(refusalOf(nh), "/wrong_type/radius must be a number, got the boolean 1");
  nh.deleteParam("radius");
  nh.setParam("planner", std::vector<int>{1, 2});
  EXPECT_EQ(refusalOf(nh).substr(0, 54), "/wrong_type/planner must be a string, got the list {1,");
}

TEST(Parameters, ValuesOutOfLimitsAreRefusedNeverClamped) {
  ros::NodeHandle nh("/out_of_limits");
  nh.setParam("free_weight", 0);
  EXPECT_EQ(refusalOf(nh), "/out_of_limits/free_weight must be a number from 1 to 65535, got 0");
  nh.deleteParam("free_weight");
  nh.setParam("radius", std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(refusalOf(nh).find("/out_of_limits/radius must be a number from 0 to 1000 m"),
            std::string::npos);
  nh.deleteParam("radius");
  nh.setParam("heuristic", "crow");
  EXPECT_EQ(refusalOf(nh),
            "/out_of_limits/heuristic must be one of zero, manhattan, chebyshev, "
            "octile, euclidean, blocks, landmark, exact, got 'crow'");
}

TEST(Parameters, UnknownNamesAreFound) {
  ros::NodeHandle nh("/misspelt");
  nh.setParam("radius", 1.0);
  nh.setParam("radios", 1.0);
  nh.setParam("nested/name", 1.0);
  XmlRpc::XmlRpcValue hyphened;  // as the command line spells them; no name of the ROS graph
  hyphened["unknown-weight"] = 2.0;
  nh.setParam("below", hyphened);
  ros::NodeHandle below("/misspelt/below");
  EXPECT_EQ(unknownParameters(below, optionNames<Options>()),
            std::vector<std::string>{"unknown-weight"});
  EXPECT_NO_THROW(warnUnknownParameters(below, optionNames<Options>()));
  EXPECT_EQ(unknownParameters(nh, optionNames<Options>()),
            (std::vector<std::string>{"below", "nested", "radios"}));
  test::Latest<rosgraph_msgs::Log> log(ros::NodeHandle(), "/rosout");
  ASSERT_TRUE(test::waitFor([&] { return log.connected(); }));
  warnUnknownParameters(nh, optionNames<Options>());
  EXPECT_TRUE(log.waitFor(0, [](const rosgraph_msgs::Log& line) {
    return line.msg == "Unknown parameter /misspelt/radios is not used; did you mean radius?";
  }));
}

TEST(Parameters, NestedNamesAreNamesWithAnUnderscoreForDynamicReconfigure) {
  ros::NodeHandle nh("/nested");
  nh.setParam("sensor_model/hit", 0.8);
  nh.setParam("sensor_model/hitt", 0.8);
  nh.setParam("sensor_model_miss", 0.3);  // what dynamic_reconfigure stores
  const auto known = optionNames<ProjectedMapOptions>();
  EXPECT_EQ(unknownParameters(nh, known), std::vector<std::string>{"sensor_model/hitt"});
  ProjectedMapOptions options;
  loadParameters(nh, options);
  EXPECT_EQ(options.octree.hit, 0.8);
  double hit = 0.0;
  EXPECT_TRUE(dynamic_reconfigure::ConfigTools::getParameter(configMessage(options),
                                                             "sensor_model_hit", hit));
  EXPECT_EQ(hit, 0.8);
  options.octree.miss = 0.2;
  storeParameters(nh, options);
  EXPECT_EQ(nh.param("sensor_model/miss", 0.0), 0.2);
}

// A request for the whole dictionary would replace what it does not name.
TEST(Parameters, StoringKeepsWhatOthersHaveSet) {
  ros::NodeHandle nh("/stored");
  nh.setParam("plugin/rate", 5);
  nh.setParam("sensor_model/theirs", std::string("kept"));
  nh.setParam("resolution", 1);  // a number that is none to dynamic_reconfigure
  storeParameters(nh, ProjectedMapOptions());
  EXPECT_EQ(nh.param("plugin/rate", 0), 5);
  EXPECT_EQ(nh.param("sensor_model/theirs", std::string()), "kept");
  XmlRpc::XmlRpcValue resolution;
  ASSERT_TRUE(nh.getParam("resolution", resolution));
  EXPECT_EQ(resolution.getType(), XmlRpc::XmlRpcValue::TypeDouble);
  for (const std::string& name : optionNames<ProjectedMapOptions>())
    EXPECT_TRUE(nh.hasParam(name)) << name;
}

TEST(Parameters, AValueInThePlaceOfAGroupIsNoGroup) {
  ros::NodeHandle nh("/flat");
  nh.setParam("sensor_model", 3);
  ProjectedMapOptions options;
  loadParameters(nh, options);
  EXPECT_EQ(options.octree.hit, ProjectedMapOptions().octree.hit);
  storeParameters(nh, options);
  EXPECT_EQ(nh.param("sensor_model/hit", 0.0), options.octree.hit);
}

class Reconfiguration : public testing::Test {
 protected:
  Reconfiguration() : nh_("/reconfigured"), log_(ros::NodeHandle(), "/rosout") {
    EXPECT_TRUE(test::waitFor([&] { return log_.connected(); }));
    initial_.planner.costmap.radius = 0.5;
    nh_.setParam("connectivity", 8);  // as YAML reads it
    reconfigurable_ = std::make_unique<Reconfigurable<PathPlannerConfig, Options>>(
        nh_, initial_, [this](const Options& options) {
          checkCostmapOptions(options.planner.costmap);
          applied_.push_back(options);
        });
  }

  dynamic_reconfigure::Config request(const dynamic_reconfigure::Config& wanted) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config = wanted;
    EXPECT_TRUE(ros::service::call("/reconfigured/set_parameters", call));
    return call.response.config;
  }
  bool loggedReason(const std::string& reason) {
    return log_
        .waitFor(0,
                 [&](const rosgraph_msgs::Log& line) {
                   return line.msg.find(reason) != std::string::npos;
                 })
        .has_value();
  }
  double parameter(const std::string& name) {
    double value = -1.0;
    nh_.getParam(name, value);
    return value;
  }

  ros::NodeHandle nh_;
  test::Latest<rosgraph_msgs::Log> log_;
  Options initial_;
  std::vector<Options> applied_;
  std::unique_ptr<Reconfigurable<PathPlannerConfig, Options>> reconfigurable_;
};

TEST_F(Reconfiguration, AnAcceptedRequestIsAppliedOnce) {
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "radius", 0.75);
  ConfigTools::appendParameter(wanted, "connectivity", std::string("4"));
  const auto answer = request(wanted);
  ASSERT_EQ(applied_.size(), 1u);
  EXPECT_EQ(applied_[0].planner.costmap.radius, 0.75);
  EXPECT_EQ(applied_[0].planner.costmap.motion.connectivity, Connectivity::FOUR);
  double radius = 0.0;
  EXPECT_TRUE(ConfigTools::getParameter(answer, "radius", radius));
  EXPECT_EQ(radius, 0.75);
  EXPECT_EQ(parameter("radius"), 0.75);
}

TEST_F(Reconfiguration, OutOfLimitsLeavesTheOldValueAndNamesTheReason) {
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "radius", -1.0);
  ConfigTools::appendParameter(wanted, "kernel", 3);
  const auto answer = request(wanted);
  EXPECT_TRUE(applied_.empty());
  double radius = 0.0;
  int kernel = 0;
  EXPECT_TRUE(ConfigTools::getParameter(answer, "radius", radius));
  EXPECT_TRUE(ConfigTools::getParameter(answer, "kernel", kernel));
  EXPECT_EQ(radius, 0.5) << "the value in force before, not a limit";
  EXPECT_EQ(kernel, 1) << "a request is taken as a whole";
  EXPECT_EQ(parameter("radius"), 0.5);
  EXPECT_TRUE(loggedReason("radius must be a number from 0 to 1000 m, got -1"));
}

TEST_F(Reconfiguration, AContradictionIsRevertedWithItsReason) {
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "free_max", 70);
  const auto answer = request(wanted);
  EXPECT_TRUE(applied_.empty());
  int free_max = 0;
  EXPECT_TRUE(ConfigTools::getParameter(answer, "free_max", free_max));
  EXPECT_EQ(free_max, 25);
  EXPECT_TRUE(loggedReason("free_max must be below occupied_min, got 70 and 65"));
}

// dynamic_reconfigure's answer is the old values and no reason: a slider of rqt jumped back, and nothing
// said why.
TEST_F(Reconfiguration, TheReasonOfARefusalIsLatched) {
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "radius", -1.0);
  request(wanted);
  test::Latest<std_msgs::String> reason(nh_, "parameter_refused");
  test::Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  const auto told = reason.waitForMoreThan(0);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->data, "radius must be a number from 0 to 1000 m, got -1");
  const auto warned = diagnostics.waitForMoreThan(0);
  ASSERT_TRUE(warned);
  EXPECT_EQ(warned->status.at(0).name, "reconfigured: parameters");
  EXPECT_EQ(warned->status.at(0).level, diagnostic_msgs::DiagnosticStatus::WARN);
  const std::size_t seen = reason.count();
  ConfigTools::clear(wanted);
  ConfigTools::appendParameter(wanted, "radius", 0.6);
  request(wanted);
  ASSERT_TRUE(reason.waitForMoreThan(seen));
  EXPECT_EQ(reason.all().back().data, "");
}

TEST_F(Reconfiguration, AnUnknownChoiceIsReverted) {
  dynamic_reconfigure::Config wanted;
  ConfigTools::appendParameter(wanted, "heuristic", std::string("crow"));
  std::string heuristic;
  EXPECT_TRUE(ConfigTools::getParameter(request(wanted), "heuristic", heuristic));
  EXPECT_EQ(heuristic, "octile");
  EXPECT_TRUE(loggedReason("heuristic must be one of zero"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
