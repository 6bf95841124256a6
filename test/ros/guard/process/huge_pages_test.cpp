// Maps of 16 MB at 10 Hz: the kernel mapped, cleared and took back 4,096 pages of 4 kB for each, twice, in every node.
#include "ros/guard/process/huge_pages.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "nav_msgs/OccupancyGrid.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {
namespace {

// Whether the system was advised of the memory at this address, as /proc/self/smaps has it.
bool isAdvised(const void* address) {
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool is_there = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t first = 0, end = 0;
    char dash = 0;
    std::istringstream range(line);
    if (range >> std::hex >> first >> dash >> end && dash == '-')
      is_there = first <= place && place < end;
    if (is_there && line.compare(0, 8, "VmFlags:") == 0)
      return (line + " ").find(" hg ") != std::string::npos;
  }
  return false;
}

class Mapped {
 public:
  explicit Mapped(std::size_t bytes)
      : bytes_(bytes),
        memory_(
            ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {}
  ~Mapped() { ::munmap(memory_, bytes_); }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  char* at(std::size_t byte) const { return static_cast<char*>(memory_) + byte; }

 private:
  const std::size_t bytes_;
  void* const memory_;
};

TEST(HugePages, AreAdvisedForLargeBlocksOnly) {
  const Mapped large(2 * kLargeBlock), small(kLargeBlock);
  adviseHugePages(large.at(16), kLargeBlock + 1);  // as a block of glibc's begins
  adviseHugePages(small.at(0), kLargeBlock - 1);
  EXPECT_TRUE(isAdvised(large.at(kLargeBlock / 2)));
  EXPECT_FALSE(isAdvised(large.at(0)));  // a page of which a part belongs to others
  EXPECT_FALSE(isAdvised(large.at(kLargeBlock + 8192)));
  EXPECT_FALSE(isAdvised(small.at(kLargeBlock / 2)));
}

TEST(HugePages, LargeMessagesAreReceivedInto) {
  nav_msgs::OccupancyGrid sent;
  sent.header.frame_id = "map";
  sent.info.width = sent.info.height = 3000;
  for (std::uint32_t i = 0; i < 9'000'000; ++i)
    sent.data.push_back(static_cast<std::int8_t>(i % 101));
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(sent);
  CheckedMessages<const nav_msgs::OccupancyGrid&> helper([](const nav_msgs::OccupancyGrid&) {});
  ros::SubscriptionCallbackHelperDeserializeParams params;
  params.buffer = bytes.message_start;
  params.length = static_cast<std::uint32_t>(bytes.num_bytes - 4);  // its length is sent before it
  const auto received =
      boost::static_pointer_cast<const nav_msgs::OccupancyGrid>(helper.deserialize(params));
  EXPECT_EQ(received->data, sent.data);
  EXPECT_EQ(received->header.frame_id, "map");
  EXPECT_TRUE(isAdvised(received->data.data() + received->data.size() / 2));
}

}  // namespace
}  // namespace grid_path_planner::nodes
