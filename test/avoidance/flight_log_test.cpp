// Flight logs as files: what is no log is refused with a sentence, at once and without the memory it claims.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "grid_path_planner/avoidance/flight_log.h"
#include "grid_path_planner/base/errors.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::avoidance {
namespace {

std::string replayError(const std::string& file) {
  return test::errorText([&] { replayFlight(file); });
}

class FlightLogFile : public testing::Test {
 protected:
  void append(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary | std::ios::app) << bytes;
  }
  void replaceOption(const std::string& line, const std::string& by) const {
    std::ifstream in(file_, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    ASSERT_NE(text.find(line), std::string::npos) << text;
    text.replace(text.find(line), line.size(), by);
    std::ofstream(file_, std::ios::binary) << text;
  }

  const test::TemporaryFolder folder_;
  const std::string file_ = folder_.path("flight.log");
};

TEST_F(FlightLogFile, DevicesAndPipesAreRefused) {
  EXPECT_NE(replayError("/dev/zero").find("no regular file"), std::string::npos);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_NE(replayError(file_).find("no regular file"), std::string::npos);
}

TEST_F(FlightLogFile, OtherFilesAreRefused) {
  append("a line of another file\n");
  EXPECT_NE(replayError(file_).find("is no flight log"), std::string::npos);
}

// Behind the options, a record that claims 2^28 bytes and has two: it was cut off.
TEST_F(FlightLogFile, ARecordThatIsCutOffEndsTheLog) {
  { FlightLog log(file_, PilotOptions(), 1 << 20); }
  append(std::string("u\0\0\0\x10\0\0\0\0ab", 11));
  EXPECT_EQ(replayFlight(file_).updates, 0u);
  { FlightLog log(file_, PilotOptions(), 1 << 20); }
  append(std::string("u\0\0\0\0\x01\0\0\0ab", 11));
  EXPECT_NE(replayError(file_).find("a record of 4294967296 bytes"), std::string::npos);
}

TEST_F(FlightLogFile, OptionsOutsideTheirLimitsAreNamed) {
  { FlightLog log(file_, PilotOptions(), 1 << 20); }
  replaceOption("max_speed: 2\n", "max_speed: fast\n");
  EXPECT_NE(replayError(file_).find("max_speed"), std::string::npos) << replayError(file_);
  { FlightLog log(file_, PilotOptions(), 1 << 20); }
  replaceOption("recover: true\n", "recover: perhaps\n");
  EXPECT_NE(replayError(file_).find("recover"), std::string::npos) << replayError(file_);
}

TEST_F(FlightLogFile, EveryDigitOfAnOptionIsKept) {
  PilotOptions options;
  options.d_safe = 0.1 + 0.2 + 0.3;
  options.rules = Rules::PUBLISHED;
  { FlightLog log(file_, options, 1 << 20); }
  std::ifstream in(file_);
  std::string line, found;
  while (std::getline(in, line))
    if (line.rfind("d_safe: ", 0) == 0) found = line.substr(8);
  EXPECT_EQ(std::stod(found), options.d_safe);
}

TEST_F(FlightLogFile, AFullDiskIsSaid) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  EXPECT_NE(test::errorText([] {
              FlightLog log("/dev/full", PilotOptions(), 1 << 20);
            }).find("cannot be written"),
            std::string::npos);
}

// After `limit` bytes nothing more is written, which is no failure; what is there can be flown again.
TEST_F(FlightLogFile, AFullLogIsRepeated) {
  FlightLog log(file_, PilotOptions(), 40);
  log.forget();
  log.cancel("asked for by the test, at some length");
  EXPECT_TRUE(log.full());
  EXPECT_EQ(log.problem(), "its limit is reached");
  EXPECT_EQ(replayFlight(file_).updates, 0u);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
