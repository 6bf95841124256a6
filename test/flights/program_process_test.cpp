// Programs that do not read, do not end their lines or end at once. What was seen: a program that did not read its
// frame held a study for ever, one that ended before its first word left two descriptors and a zombie each flight.
#include "flights/program_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "support/error_text.h"

namespace grid_path_planner::flights {
namespace {

using test::contains, test::errorText;
using Clock = std::chrono::steady_clock;

Clock::time_point soon() {
  return Clock::now() + std::chrono::milliseconds(300);
}

Clock::time_point late() {
  return Clock::now() + std::chrono::seconds(60);
}

std::size_t openDescriptors() {
  const std::filesystem::directory_iterator open("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(open), end(open)));
}

TEST(ProgramProcess, AnswersLineByLine) {
  ProgramProcess echo({"cat"});
  echo.send("one\ntwo\n", 8, late());
  EXPECT_EQ(echo.receiveLine(late()), "one");
  EXPECT_EQ(echo.receiveLine(late()), "two");
}

TEST(ProgramProcess, OneThatDoesNotReadIsGivenUp) {
  ProgramProcess deaf({"sleep", "600"});
  const std::vector<char> frame(1 << 20);
  EXPECT_TRUE(
      contains(errorText([&] { deaf.send(frame.data(), frame.size(), soon()); }), "in time"));
}

TEST(ProgramProcess, OneThatDoesNotEndItsLineIsGivenUp) {
  ProgramProcess slow({"sh", "-c", "while :; do printf x; sleep 0.02; done"});
  EXPECT_TRUE(contains(errorText([&] { slow.receiveLine(soon()); }), "in time"));
  ProgramProcess endless({"cat", "/dev/zero"});
  EXPECT_TRUE(contains(errorText([&] { endless.receiveLine(late()); }), "without end"));
}

TEST(ProgramProcess, OneThatEndsLeavesNothingBehind) {
  const std::size_t before = openDescriptors();
  for (int flight = 0; flight < 20; ++flight) {
    ProgramProcess gone({"true"});
    EXPECT_TRUE(contains(errorText([&] { gone.receiveLine(late()); }), "has ended"));
    const std::vector<char> frame(1 << 20);
    EXPECT_TRUE(
        contains(errorText([&] { gone.send(frame.data(), frame.size(), late()); }), "has ended"));
  }
  EXPECT_THROW(ProgramProcess({"/no/such/program"}), base::InputError);
  EXPECT_EQ(openDescriptors(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child was not waited for";
}

}  // namespace
}  // namespace grid_path_planner::flights
