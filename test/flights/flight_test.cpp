#include "flights/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "flights/flight_plan.h"
#include "flights/small_flights.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "grid_path_planner/flights/flight_job.h"
#include "grid_path_planner/study/process_pool.h"
#include "support/error_text.h"

namespace grid_path_planner::flights {
namespace {

using study::ProcessPool, study::StudyOutcome;
using test::contains, test::errorText, test::SmallFlights;

FlightRecord flown(const std::string& file, int seed = 1) {
  const FlightStudy study = readFlightFile(file);
  const FlightSetup setup(study, 0);
  return fly(setup, 0, seed);
}

TEST(Flight, TheSmallestProgramFliesThereAndHome) {
  const SmallFlights small;
  const FlightRecord flight = flown(small.write(SmallFlights::program("straight")));
  EXPECT_EQ(flight.end, FlightEnd::HOME) << flight.sentence;
  EXPECT_EQ(flight.waypoints, 2);
  EXPECT_NEAR(flight.length_m, 11.0, 1.0) << "two legs of 6 m, less the radii of arrival";
  EXPECT_LT(flight.max_speed, 2.0 + 1e-9);
  EXPECT_LT(flight.clearance_m, 1.6);
  EXPECT_GT(flight.clearance_m, 1.2);
}

// Its last waypoint lies behind the vehicle, which does not turn.
TEST(Flight, SpaceThatTheCameraNeverSawIsCounted) {
  const SmallFlights small;
  EXPECT_EQ(flown(small.write(SmallFlights::program("straight"))).unseen, 0);
  const FlightRecord back =
      flown(small.write(SmallFlights::program("straight"), "", "[[-6, 0, 1.5]]"));
  EXPECT_EQ(back.end, FlightEnd::HOME);
  EXPECT_GT(back.unseen, 20);
}

TEST(Flight, AContactEndsItAndIsNamed) {
  const SmallFlights small;
  const FlightRecord flight =
      flown(small.write(SmallFlights::program("straight"), "", "[[6, 4, 1.5]]"));
  EXPECT_EQ(flight.end, FlightEnd::CONTACT);
  EXPECT_EQ(flight.sentence, "post::l::c");
  EXPECT_NEAR((flight.at - Eigen::Vector3d(3, 2, 1.5)).norm(), 0.5, 0.01);
  EXPECT_GT(flight.speed, 0.2) << "the speed before the contact";
}

TEST(Flight, ABodyThatComesIsAContact) {
  const SmallFlights small;
  const FlightRecord flight = flown(small.write(
      SmallFlights::program("hover"),
      "bodies: [{name: ball, shape: sphere, half_size: [0.4, 0.4, 0.4], track: [[0, 6, 0, "
      "1.5], [6, -6, 0, 1.5]]}]"));
  EXPECT_EQ(flight.end, FlightEnd::CONTACT);
  EXPECT_EQ(flight.sentence, "ball");
  EXPECT_LT(flight.speed, 0.01);
  EXPECT_NEAR(flight.time_s, 2.7, 0.3);
}

TEST(Flight, EveryOtherEndHasItsName) {
  const SmallFlights small;
  const auto endOf = [&](const std::string& habit) {
    return flown(small.write(SmallFlights::program(habit)));
  };
  EXPECT_EQ(endOf("hover").end, FlightEnd::TIMEOUT);
  EXPECT_EQ(endOf("climb").end, FlightEnd::FENCE);
  EXPECT_EQ(endOf("believe").end, FlightEnd::LOST);
  EXPECT_EQ(endOf("babble").end, FlightEnd::FAILED);
  EXPECT_TRUE(contains(endOf("babble").sentence, "answered 'good morning'"));
  EXPECT_EQ(endOf("leave").end, FlightEnd::FAILED);
  EXPECT_TRUE(contains(endOf("leave").sentence, "has ended"));
}

const char* const kOurs =
    "  - {name: ours, pilot: {no_return_clears: 10, search: tree, memory: 15}}\n";

TEST(FlightLaw, SeedsRepeatToTheBitAndDiffer) {
  const SmallFlights small;
  const FlightStudy study = readFlightFile(small.write(kOurs));
  const FlightSetup setup(study, 0), again(study, 0);
  const FlightRecord first = fly(setup, 0, 1);
  EXPECT_EQ(first.end, FlightEnd::HOME) << first.sentence;
  EXPECT_EQ(first.unseen, 0);
  EXPECT_NE(fly(setup, 0, 2).bits, first.bits);
  EXPECT_EQ(fly(setup, 0, 1).bits, first.bits) << "after other flights";
  EXPECT_EQ(fly(again, 0, 1).bits, first.bits);
}

std::string tableOf(const std::string& file, const std::string& folder, std::size_t jobs) {
  const FlightJob job(file);
  ProcessPool pool(jobs, job.work());
  const StudyOutcome outcome =
      job.run({folder, "a test", "", ""}, pool, base::StopToken(), [](std::size_t) {});
  EXPECT_TRUE(outcome.failures.empty());
  return test::contentOf(folder + "/flights.csv");
}

TEST(FlightLaw, AnyNumberOfJobsAndAnInterruptionGiveTheSameFlights) {
  const SmallFlights small;
  const std::string file = small.write(kOurs + SmallFlights::program("straight"), "flights: 3");
  const std::string one = tableOf(file, small.folder.path("one"), 1);
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 7);
  EXPECT_EQ(tableOf(file, small.folder.path("two"), 2), one);
  const std::string runs = test::contentOf(small.folder.path("one/runs.jsonl"));
  small.folder.write("one/runs.jsonl", runs.substr(0, runs.size() * 2 / 3));  // cut off in a line
  EXPECT_EQ(tableOf(file, small.folder.path("one"), 1), one);
}

// The page of 300 flights was written over by that of a few.
TEST(FlightLaw, AnInterruptedStudyLeavesThePageOfResultsAsItIs) {
  const SmallFlights small;
  const FlightJob job(small.write(SmallFlights::program("believe"), "flights: 3"));
  const std::string page = small.folder.write("page.md", "before");
  const auto run = [&](std::size_t last) {  // ends when so many have flown
    base::StopSource stop;
    ProcessPool pool(1, job.work());
    return job.run({small.folder.path("out"), "a test", page, ""}, pool, stop.token(),
                   [&](std::size_t done) {
                     if (done == last) stop.cancel();
                   });
  };
  EXPECT_EQ(run(1).runs, 1u);
  EXPECT_EQ(test::contentOf(page), "before");
  EXPECT_TRUE(contains(test::contentOf(small.folder.path("out/report.html")), "are missing"));
  EXPECT_EQ(run(0).runs, 3u);
  EXPECT_TRUE(contains(test::contentOf(page), "3 flights."));
}

TEST(FlightLaw, TheLogOfAFlightRepeatsToTheBit) {
  const SmallFlights small;
  const FlownAgain flight =
      FlightJob(small.write(kOurs)).flyOne("ours/1", small.folder.path("one"));
  EXPECT_TRUE(flight.came_home) << flight.outcome;
  EXPECT_EQ(flight.name, "ours/1/safe");
  const avoidance::ReplayResult replay = avoidance::replayFlight(flight.log);
  EXPECT_EQ(replay.differing, 0u) << replay.first_difference;
  EXPECT_GT(replay.updates, 100u);
  EXPECT_TRUE(contains(test::contentOf(flight.picture), "<polyline"));
}

TEST(FlightRecord, ALineHoldsAllOfIt) {
  FlightRecord record;
  record.variant = 3;
  record.end = FlightEnd::STUCK;
  record.sentence = "came as near as 3 m \"so\"";
  record.bits = 0xffffffffffffffffu;
  record.path = {{1.5f, -2.25f, 1.5f}};
  EXPECT_EQ(lineOf(recordFromLine(lineOf(record))), lineOf(record));
  EXPECT_TRUE(contains(errorText([] { recordFromLine("{}"); }), "is not the line of a flight"));
}

// What a number of another size became as an int or an index was undefined, or another flight.
TEST(FlightRecord, ALineWithANumberThatIsNoneOfItsKindIsRefused) {
  const std::string line = lineOf(FlightRecord());
  const auto with = [&line](const std::string& name, const std::string& number) {
    std::string changed = line;
    const std::string field = "\"" + name + "\":";
    return changed.replace(changed.find(field + "0"), field.size() + 1, field + number);
  };
  EXPECT_EQ(errorText([&] { recordFromLine(with("seed", "7")); }), "");
  EXPECT_EQ(errorText([&] { recordFromLine(with("bits", "18446744073709551615")); }), "");
  for (const char* number : {"1e300", "0.5", "2147483648", "-2147483649", "\"7\""})
    EXPECT_TRUE(contains(errorText([&] { recordFromLine(with("seed", number)); }),
                         std::string("a whole number must stand where ")))
        << number;
  for (const char* number : {"-1", "18446744073709551616"})
    EXPECT_NE(errorText([&] { recordFromLine(with("variant", number)); }), "") << number;
}

// Flights of before went on as those of another mesh or program, whose names were the same.
TEST(FlightPlan, AnotherMeshOrProgramIsAnotherStudy) {
  const SmallFlights small;
  const auto mesh = [&small](const char* height) {
    small.folder.write("post.obj",
                       std::string("v 3 2 0\nv 4 2 0\nv 3 2 ") + height + "\nf 1 2 3\n");
  };
  small.folder.write("field.sdf",
                     "<sdf version='1.6'><world name='field'><model name='post'><static>1</static>"
                     "<link name='l'><collision name='c'><geometry><mesh><uri>post.obj</uri>"
                     "</mesh></geometry></collision></link></model></world></sdf>");
  const std::string file = small.write("  - {name: mine, pilot: {program: [./mine.py, " +
                                       small.folder.path("weights.txt") + "]}}\n");
  const auto fingerprint = [&file] { return FlightPlan(readFlightFile(file)).fingerprint(); };
  std::set<std::uint64_t> prints;
  const auto isAnother = [&] { return prints.insert(fingerprint()).second; };
  mesh("3");
  EXPECT_TRUE(isAnother()) << "the program is not there yet";
  EXPECT_FALSE(isAnother());
  mesh("4");
  EXPECT_TRUE(isAnother());
  small.folder.write("mine.py", "print('left')\n");
  EXPECT_TRUE(isAnother());
  small.folder.write("mine.py", "print('right')\n");
  EXPECT_TRUE(isAnother());
  small.folder.write("weights.txt", "0.5\n");
  EXPECT_TRUE(isAnother());
  small.folder.write("weights.txt", "0.6\n");
  EXPECT_TRUE(isAnother());
}

TEST(FlightPlan, FlightsAreFoundByTheBeginningOfTheirNames) {
  const SmallFlights small;
  const FlightPlan plan(
      readFlightFile(small.write("  - {name: LHLM}\n  - {name: LHLM2, flights: 1}\n",
                                 "rules: [published, safe]\nflights: 12")));
  EXPECT_EQ(plan.units().size(), 26u);
  EXPECT_EQ(plan.nameOf(plan.unitOf("LHLM/7")), "LHLM/7/published");
  EXPECT_EQ(plan.nameOf(plan.unitOf("LHLM/1/safe")), "LHLM/1/safe");
  EXPECT_EQ(plan.nameOf(plan.unitOf("LHLM2")), "LHLM2/1/published");
  EXPECT_TRUE(contains(errorText([&] { plan.unitOf("LHLM/70"); }), "has no flight 'LHLM/70'"));
}

}  // namespace
}  // namespace grid_path_planner::flights
