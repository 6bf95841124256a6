#include "grid_path_planner/study/process_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <map>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::study {

using base::InputError;

namespace {

using Clock = std::chrono::steady_clock;

// Does the tasks 0 to `tasks` - 1 and gives how they ended.
std::map<std::size_t, TaskEnd> doAll(ProcessPool& pool, std::size_t tasks) {
  std::map<std::size_t, TaskEnd> ends;
  const auto deadline = Clock::now() + std::chrono::seconds(60);
  for (std::size_t next = 0; ends.size() < tasks && Clock::now() < deadline;) {
    for (; next < tasks && pool.idle() > 0; ++next) pool.start(next);
    for (const TaskEnd& end : pool.wait(100)) ends[end.task] = end;
  }
  return ends;
}

TEST(ProcessPool, DoesEveryTaskOnce) {
  ProcessPool pool(3, [](std::size_t task) { return std::string(task * 1000, 'x'); });
  const auto ends = doAll(pool, 200);
  ASSERT_EQ(ends.size(), 200u);
  for (const auto& end : ends) {
    EXPECT_FALSE(end.second.failed);
    EXPECT_EQ(end.second.text.size(), end.first * 1000) << "answers longer than a pipe holds too";
  }
  EXPECT_EQ(pool.busy(), 0u);
}

TEST(ProcessPool, AnExceptionFailsItsTaskAndNoOther) {
  ProcessPool pool(2, [](std::size_t task) {
    if (task == 3) throw InputError("no such thing as three");
    return std::to_string(task);
  });
  const auto ends = doAll(pool, 6);
  ASSERT_EQ(ends.size(), 6u);
  EXPECT_TRUE(ends.at(3).failed);
  EXPECT_EQ(ends.at(3).text, "no such thing as three");
  EXPECT_EQ(ends.at(4).text, "4");
}

TEST(ProcessPool, AWorkerThatIsKilledIsReplaced) {
  ProcessPool pool(1, [](std::size_t task) {
    if (task == 1) ::kill(::getpid(), SIGKILL);
    if (task == 2) ::_exit(7);
    return std::to_string(task);
  });
  const auto ends = doAll(pool, 5);
  ASSERT_EQ(ends.size(), 5u);
  EXPECT_TRUE(ends.at(1).failed);
  EXPECT_EQ(ends.at(1).text, "its worker was ended by signal 9 (Killed)");
  EXPECT_TRUE(ends.at(2).failed);
  EXPECT_EQ(ends.at(2).text, "its worker ended with code 7");
  EXPECT_EQ(ends.at(4).text, "4");
}

TEST(ProcessPool, EndsItsWorkersWithItself) {
  pid_t worker = 0;
  {
    ProcessPool pool(1, [](std::size_t) { return std::to_string(::getpid()); });
    worker = static_cast<pid_t>(std::stol(doAll(pool, 1).at(0).text));
    EXPECT_EQ(::kill(worker, 0), 0);
  }
  EXPECT_NE(::kill(worker, 0), 0);
}

}  // namespace
}  // namespace grid_path_planner::study
