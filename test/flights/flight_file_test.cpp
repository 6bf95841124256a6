#include <gtest/gtest.h>

#include "flights/flight_study.h"
#include "flights/small_flights.h"
#include "support/error_text.h"

namespace grid_path_planner::flights {
namespace {

using avoidance::Rules;
using test::contains, test::errorText, test::SmallFlights;

TEST(FlightFile, TheStudyOfTheRescueCourseIsTheNineUnderBothRulesAndOurs) {
  const FlightStudy study = readFlightFile("config/flights_rescue.yaml");
  ASSERT_EQ(study.variants.size(), 19u);
  EXPECT_EQ(study.variants.front().label(), "best safe");
  EXPECT_EQ(study.variants[1].label(), "LHLM published");
  EXPECT_EQ(study.variants[2].label(), "LHLM safe");
  EXPECT_EQ(study.variants[2].pilot.look_ahead, 8.0);
  EXPECT_EQ(study.variants[2].pilot.memory, 15.0);
  EXPECT_FALSE(study.variants[2].pilot.recover);
  for (const FlightVariant& variant : study.variants) EXPECT_EQ(variant.flights, 20);
  EXPECT_EQ(study.published.size(), 9u);
  EXPECT_EQ(study.published.at("LHLM").time_s, 75.3);
  EXPECT_EQ(study.pairs.size(), 5u);
  EXPECT_EQ(study.conclusions.size(), 5u);
  EXPECT_EQ(study.route.size(), 5u);
  EXPECT_NEAR(study.camera.horizontal_fov, 74.5 * M_PI / 180.0, 1e-4);
}

TEST(FlightFile, TheOtherStudiesAreReadAndNoReportedSeedIsOneOfTuning) {
  const auto worldsOf = [](const std::string& file) { return readFlightFile(file).worlds; };
  ASSERT_EQ(worldsOf("config/flights_tuning.yaml").size(), 20u);
  EXPECT_EQ(worldsOf("config/flights_tuning.yaml").front().name, "course_100");
  ASSERT_EQ(worldsOf("config/flights_courses.yaml").size(), 50u);
  EXPECT_EQ(worldsOf("config/flights_courses.yaml").front().name, "course_200");
  EXPECT_EQ(readFlightFile("config/flights_many.yaml").variants.front().flights, 300);
}

TEST(FlightFile, OtherVehiclesAreOptionsOfThePilot) {
  const FlightStudy rov = readFlightFile("config/flights/rov.yaml");
  EXPECT_TRUE(rov.variants.front().pilot.elevation);
  const FlightStudy ground = readFlightFile("config/flights/ground.yaml");
  EXPECT_FALSE(ground.variants.front().pilot.elevation);
  EXPECT_FALSE(ground.variants.front().pilot.sway);
  for (const FlightStudy& study :
       {rov, ground}) {  // the pilot must not ask for more than the vehicle can
    const avoidance::PilotOptions& pilot = study.variants.front().pilot;
    EXPECT_LE(pilot.max_speed, study.vehicle.max_surge_speed);
    EXPECT_LE(pilot.max_acceleration, study.vehicle.max_acceleration);
    EXPECT_LE(pilot.max_yaw_rate, study.vehicle.max_yaw_rate + 1e-9);
    EXPECT_GE(pilot.response_time, study.vehicle.response_time);
  }
}

TEST(FlightFile, MistakesAreToldWithFileAndLine) {
  const SmallFlights small;
  const auto refusal = [&](const std::string& configurations, const std::string& more = "") {
    const std::string file = small.write(configurations, more);
    return errorText([&] { readFlightFile(file); });
  };
  const std::string good = "  - {name: a}\n";
  EXPECT_EQ(refusal(good), "");
  EXPECT_TRUE(contains(refusal("  - {name: a, pilot: {memmory: 3}}\n"),
                       "study.yaml:12: the pilot has no option 'memmory'"));
  EXPECT_TRUE(contains(refusal("  - {name: a, pilot: {d_safe: -3}}\n"), "d_safe"));
  EXPECT_TRUE(contains(refusal(good + good), "configurations has 'a safe' twice"));
  EXPECT_TRUE(contains(refusal(good, "command_rate: 0"), "command_rate is out of limits"));
  EXPECT_TRUE(contains(refusal(good, "rules: [careful]"), "published, safe"));
  EXPECT_TRUE(contains(refusal(good, "speed: 3"), "has no 'speed'"));
  EXPECT_TRUE(contains(refusal(good,
                               "bodies: [{name: b, shape: sphere, half_size: [0, 1, 1], track: "
                               "[[0, 1, 1, 1]]}]"),
                       "b: sizes of a moving body"));
}

// Found by the fuzzer: a library's error named neither file nor line.
TEST(FlightFile, AListThatIsMissingIsToldWithFileAndLine) {
  const SmallFlights small;
  const auto refusal = [&](const std::string& more) {
    return errorText([&] { readFlightFile(small.write("  - {name: a}\n  - {name: b}\n", more)); });
  };
  const std::string published = "published: {source: s, figures: {a: [1, 2, 3]}, ";
  for (const auto& [more, key] : std::vector<std::pair<std::string, std::string>>{
           {published + "pairs: [{p: [0, 0.5]}]}", "pair"},
           {published + "pairs: [{pair: [a, b]}]}", "p"},
           {published + "pairs: [{pair: [a, b], p: [0, 1]}], conclusions: [{claim: c}]}", "pairs"},
           {published + "conclusions: [{claim: c, pairs: [[a, b]]}]}", "pairs"},
           {"bodies: [{name: b, shape: sphere, half_size: [1, 1, 1]}]", "track"}})
    EXPECT_TRUE(contains(refusal(more), "has no '" + key + "' (a list)") &&
                contains(refusal(more), "study.yaml:"))
        << refusal(more);
}

// Such a pair was never tested, and its conclusion was confirmed by the others.
TEST(FlightFile, APairOfAConfigurationThatIsNoneIsToldWithFileAndLine) {
  const SmallFlights small;
  const std::string begin =
      "published:\n  source: s\n  figures: {a: [1, 2, 3]}\n  pairs: [{pair: [a, b], p: [0, 1]}]\n";
  const auto refusal = [&](const std::string& conclusions) {
    return errorText([&] {
      readFlightFile(small.write("  - {name: a}\n  - {name: b}\n", begin + conclusions));
    });
  };
  EXPECT_EQ(refusal("  conclusions: [{claim: c, pairs: [[a, b]]}]"), "");
  EXPECT_TRUE(contains(refusal("  conclusions: [{claim: c, pairs: [[a, b], [a, B]]}]"),
                       "study.yaml:14: a pair names 'B', which is no configuration"))
      << refusal("  conclusions: [{claim: c, pairs: [[a, b], [a, B]]}]");
}

// Of frames that are due between two commands only those came that fell on one: 12.5 Hz were 2.5.
TEST(FlightFile, FramesThatNoCommandTakesAreRefused) {
  const SmallFlights small;
  const auto refusal = [&](const std::string& command_rate, const std::string& camera_rate) {
    small.folder.write("vehicle.yaml", "time_step: 0.01\ncamera_rate: " + camera_rate + "\n");
    return errorText(
        [&] { readFlightFile(small.write("  - {name: a}\n", "command_rate: " + command_rate)); });
  };
  EXPECT_EQ(refusal("20", "20"), "");
  EXPECT_EQ(refusal("25", "12.5"), "");
  EXPECT_TRUE(contains(refusal("20", "12.5"),
                       "study.yaml:10: command_rate, 20 Hz, must be a multiple of camera_rate, "
                       "12.5 Hz"))
      << refusal("20", "12.5");
  EXPECT_TRUE(contains(refusal("10", "20"), "must be a multiple"));
  EXPECT_TRUE(contains(refusal("30", "10"), "the period of commands must be whole steps"));
}

// The picture of the last one was written over those of the others.
TEST(FlightFile, ConfigurationsWhosePicturesHaveOneNameAreRefused) {
  const SmallFlights small;
  const std::string file = small.write("  - {name: a b}\n  - {name: a_b}\n");
  const std::string refusal = errorText([&] { readFlightFile(file); });
  EXPECT_TRUE(contains(refusal, "study.yaml:12: ") &&
              contains(refusal, "above_a_b_safe_on_field.svg"))
      << refusal;
}

// Found by the fuzzer, as above: yaml-cpp throws where an entry that is not there is asked what it is.
TEST(FlightFile, WorldsWithoutAPatternAreToldWithFileAndLine) {
  const SmallFlights small;
  const std::string file = small.folder.write(
      "none.yaml",
      "title: Small\nworlds: [{seeds: [1, 2]}]\nstart: [0, 0, 1.5, 0]\nroute: [[6, 0, 1.5]]\n"
      "configurations: [{name: a}]\n");
  const std::string refusal = errorText([&] { readFlightFile(file); });
  EXPECT_TRUE(contains(refusal, "none.yaml:2: ") &&
              contains(refusal, "has no 'pattern' (a file name)"))
      << refusal;
}

// A seed above the largest int became the least one, from which worlds were counted up until there was no memory.
TEST(FlightFile, WorldsOfSeedsThatAreNoSeedsAreRefused) {
  const SmallFlights small;
  const auto refusal = [&](const std::string& seeds) {
    const std::string file = small.folder.write(
        "pattern.yaml", "title: Small\nworlds: [{pattern: f%d.sdf, seeds: " + seeds +
                            "}]\nstart: [0, 0, 1.5, 0]\nroute: [[6, 0, 1.5]]\n"
                            "configurations: [{name: a}]\n");
    return errorText([&] { readFlightFile(file); });
  };
  EXPECT_EQ(refusal("[7, 9]"), "");
  for (const char* seeds : {"[3e9, 3e9]", "[3000000000, 3000000000]", "[1e300, 1e300]", "[-1, 3]"})
    EXPECT_TRUE(contains(refusal(seeds), "pattern.yaml:2: a seed must be a whole number from 0"))
        << refusal(seeds);
  EXPECT_TRUE(contains(refusal("[9, 7]"), "seeds must be [first, last]"));
  EXPECT_TRUE(contains(refusal("[7]"), "seeds must have 2 numbers"));
}

}  // namespace
}  // namespace grid_path_planner::flights
