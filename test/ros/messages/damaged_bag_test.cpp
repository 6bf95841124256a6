// A damaged bag gives a map or an InputError, as every map file does.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sys/resource.h>

#include <random>

#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "support/error_text.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::checkOccupancyValues;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

// Of this process so far.
long peakKilobytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class DamagedBag : public testing::Test {
 protected:
  void readAsBag(const std::string& content) {
    const std::string file = folder_.write("a.bag", content);
    try {
      const OccupancyGrid map = readMapFromBag(file);
      EXPECT_EQ(map.values().size(), map.geometry().size());
      EXPECT_EQ(test::errorText([&] { checkOccupancyValues(map); }), "");
      ++maps_;
    } catch (const InputError& error) {
      EXPECT_TRUE(test::contains(error.what(), "a.bag")) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }

  const test::TemporaryFolder folder_;
  const std::string whole_ = test::contentOf("test/data/projected_map.bag");
  int maps_ = 0;
};

TEST_F(DamagedBag, CutOffAnywhere) {
  const std::size_t end = whole_.size() - 200;  // within its last records
  for (std::size_t size = 0; size < end; size += 61) readAsBag(whole_.substr(0, size));
  for (std::size_t size = end; size < whole_.size(); ++size) readAsBag(whole_.substr(0, size));
  EXPECT_EQ(maps_, 0);
}

TEST_F(DamagedBag, InjuredAnywhere) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 500; ++trial) readAsBag(test::mutated(whole_, random));
  EXPECT_GT(maps_, 0);
  EXPECT_LT(maps_, 500);
}

// The length of a message's list is believed only after a look at what there is.
TEST_F(DamagedBag, ALengthOfGigabytesTakesNoMemory) {
  const std::string file = folder_.path("plain.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    const OccupancyGrid map(GridGeometry(13, 17, 0.05), 0);
    bag.write("/projected_map", ros::Time(1), occupancyToMessage(map, "map", ros::Time(1)));
  }
  std::string content = test::contentOf(file);
  const std::size_t length = content.find(std::string("\xdd\0\0\0", 4));  // 13 x 17
  ASSERT_NE(length, std::string::npos);
  content[length + 3] = '\x7f';
  const long before = peakKilobytes();
  readAsBag(content);
  EXPECT_EQ(maps_, 0);
  EXPECT_LT(peakKilobytes() - before, 200000);
}

// Without the checksum of a compression, damage reaches the messages.
TEST_F(DamagedBag, InjuredAnywhereWithoutCompression) {
  const std::string file = folder_.path("plain.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    const OccupancyGrid map(GridGeometry(7, 5, 0.05), 0);
    bag.write("/projected_map", ros::Time(1), occupancyToMessage(map, "map", ros::Time(1)));
  }
  const std::string whole = test::contentOf(file);
  std::mt19937 random(7);
  for (int trial = 0; trial < 1000; ++trial) readAsBag(test::mutated(whole, random));
  EXPECT_GT(maps_, 0);
  EXPECT_LT(maps_, 1000);
}

}  // namespace
}  // namespace grid_path_planner::nodes
