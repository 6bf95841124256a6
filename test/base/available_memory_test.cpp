#include "base/available_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <limits>

#include "support/temporary_folder.h"

namespace grid_path_planner::base {
namespace {

constexpr char kMeminfo[] = "MemTotal: 9000 kB\nMemFree: 10 kB\nMemAvailable:    8000 kB\n";

// The files of a system below a folder.
class AvailableMemory : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    const std::filesystem::path file(folder_.path(name));
    std::filesystem::create_directories(file.parent_path());
    folder_.write(name, content);
  }
  std::size_t available() const { return availableMemory(folder_.path("")); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(AvailableMemory, IsWhatTheMachineTells) {
  write("proc/meminfo", kMeminfo);
  EXPECT_EQ(available(), 8000u * 1024);
}

TEST_F(AvailableMemory, IsTheLimitOfAGroupOfVersionTwo) {
  write("proc/meminfo", kMeminfo);
  write("proc/self/cgroup", "0::/user.slice/planner\n");
  write("sys/fs/cgroup/user.slice/planner/memory.max", "4000000\n");
  write("sys/fs/cgroup/user.slice/memory.max", "max\n");
  EXPECT_EQ(available(), 4000000u);
  write("sys/fs/cgroup/user.slice/memory.max", "3000000\n");
  EXPECT_EQ(available(), 3000000u) << "the group that holds it has less";
}

TEST_F(AvailableMemory, IsTheLimitOfAGroupOfVersionOne) {
  write("proc/meminfo", kMeminfo);
  write("proc/self/cgroup", "9:cpu:/\n4:hugetlb,memory:/planner\n0::/\n");
  write("sys/fs/cgroup/memory/planner/memory.limit_in_bytes", "5000000\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(available(), 5000000u);
}

TEST_F(AvailableMemory, InAContainerTheMountedFolderIsTheGroup) {
  write("proc/meminfo", kMeminfo);
  write("proc/self/cgroup", "0::/machine/outside/c0ffee\n");
  write("sys/fs/cgroup/memory.max", "2000000\n");
  EXPECT_EQ(available(), 2000000u);
}

TEST_F(AvailableMemory, IsNotMoreThanTheMachineHas) {
  write("proc/meminfo", kMeminfo);
  write("proc/self/cgroup", "0::/planner\n");
  write("sys/fs/cgroup/planner/memory.max", "99999999999\n");
  EXPECT_EQ(available(), 8000u * 1024);
}

TEST_F(AvailableMemory, ASystemThatTellsNothingLimitsNothing) {
  EXPECT_EQ(available(), std::numeric_limits<std::size_t>::max());
}

TEST_F(AvailableMemory, TheLimitOfTheAddressSpaceCounts) {
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  struct rlimit limit = before;
  limit.rlim_cur = std::size_t{1} << 40;
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  EXPECT_EQ(available(), std::size_t{1} << 40);
  ::setrlimit(RLIMIT_AS, &before);
}

TEST(HalfOfAvailableMemory, IsOneFigureForTheWholeRun) {
  const std::size_t half = halfOfAvailableMemory();
  EXPECT_GT(half, 0u);
  EXPECT_EQ(halfOfAvailableMemory(), half);
}

}  // namespace
}  // namespace grid_path_planner::base
