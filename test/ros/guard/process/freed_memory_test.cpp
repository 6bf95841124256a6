// path_planner held 455 MB after scattered changes of 4096×4096 cells, and 386 that it used: freed maps lay below others.
#include "ros/guard/process/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <utility>
#include <vector>

namespace grid_path_planner::nodes {
namespace {

constexpr long kBlock = 9 << 20;
constexpr int kBlocks = 8;

long residentBytes() {
  long size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

// Of blocks below one that stays in use; the system counts roughly, so it may be less than 0. The first round tells the
// allocator their size.
long bytesKeptOfFreedBlocks() {
  constexpr int kRounds = 3;
  const long before = residentBytes();
  std::vector<std::vector<char>> in_use;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::vector<char>> freed;
    for (int i = 0; i < kBlocks; ++i) freed.emplace_back(kBlock, 'x');
    in_use.push_back(std::move(freed.back()));
  }
  return residentBytes() - before - kRounds * kBlock;
}

// In a child, whose allocator is set up as it is at the start of a program.
bool isReturned(void (*prepare)()) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (prepare) prepare();
    ::_exit(bytesKeptOfFreedBlocks() < 2 * kBlock ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status == 0;
}

TEST(FreedMemory, GoesBackToTheSystem) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "another allocator than glibc's";
#endif
  EXPECT_TRUE(isReturned(returnFreedMemory));
  EXPECT_FALSE(isReturned(nullptr));
}

}  // namespace
}  // namespace grid_path_planner::nodes
