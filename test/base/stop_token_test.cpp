#include "grid_path_planner/base/stop_token.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace grid_path_planner::base {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

TEST(StopToken, OneOfItsOwnNeverAsksToStop) {
  EXPECT_EQ(StopToken().reason(), StopReason::NONE);
}

TEST(StopToken, AllTokensOfASourceAreCancelled) {
  StopSource source;
  const StopToken before = source.token(), limited = source.token(hours(1));
  EXPECT_EQ(before.reason(), StopReason::NONE);
  EXPECT_EQ(limited.reason(), StopReason::NONE);
  EXPECT_FALSE(source.cancelled());
  source.cancel();
  EXPECT_TRUE(source.cancelled());
  EXPECT_EQ(before.reason(), StopReason::CANCELLED);
  EXPECT_EQ(limited.reason(), StopReason::CANCELLED);
  EXPECT_EQ(source.token().reason(), StopReason::CANCELLED);
}

TEST(StopToken, CopiesOfASourceAreOne) {
  StopSource source;
  const StopSource copy = source;
  const StopToken token = copy.token();
  source.cancel();
  EXPECT_EQ(token.reason(), StopReason::CANCELLED);
  EXPECT_EQ(StopSource().token().reason(), StopReason::NONE);
}

TEST(StopToken, ALimitThatHasRunOutIsATimeout) {
  const StopSource source;
  EXPECT_EQ(source.token(seconds(0)).reason(), StopReason::TIMEOUT);
  EXPECT_EQ(source.token(seconds(-1)).reason(), StopReason::TIMEOUT);
}

TEST(StopToken, ALimitRunsOut) {
  const StopSource source;
  const StopToken token = source.token(std::chrono::milliseconds(1));
  const auto give_up = StopToken::Clock::now() + seconds(30);
  while (token.reason() == StopReason::NONE && StopToken::Clock::now() < give_up)
    std::this_thread::yield();
  EXPECT_EQ(token.reason(), StopReason::TIMEOUT);
}

TEST(StopToken, CancellingWinsOverALimitThatHasRunOut) {
  StopSource source;
  const StopToken token = source.token(seconds(0));
  source.cancel();
  EXPECT_EQ(token.reason(), StopReason::CANCELLED);
}

TEST(StopToken, OutlivesItsSource) {
  StopToken token;
  {
    StopSource source;
    token = source.token();
    source.cancel();
  }
  EXPECT_EQ(token.reason(), StopReason::CANCELLED);
}

// navigation2#4139: cancel waits for the search.
TEST(StopToken, IsSeenByAnotherThread) {
  StopSource source;
  StopReason seen = StopReason::NONE;
  std::thread worker([&seen, token = source.token(seconds(30))] {
    while (token.reason() == StopReason::NONE) std::this_thread::yield();
    seen = token.reason();
  });
  source.cancel();
  worker.join();
  EXPECT_EQ(seen, StopReason::CANCELLED);
}

TEST(StopPoll, AsksOnceInItsInterval) {
  StopSource source;
  source.cancel();
  const StopToken token = source.token();
  StopPoll poll(token, 5);
  for (int i = 0; i < 4; ++i) EXPECT_NO_THROW(poll()) << i;
  EXPECT_THROW(poll(), Stopped);
  for (int i = 0; i < 4; ++i) EXPECT_NO_THROW(poll()) << i;
  EXPECT_THROW(poll(), Stopped);
}

TEST(StopPoll, SaysWhichStatusTheReasonStandsFor) {
  const auto status = [](const StopToken& token) {
    try {
      StopPoll(token, 1)();
    } catch (const Stopped& stopped) {
      return stopped.status();
    }
    return Status::FOUND;
  };
  StopSource source;
  EXPECT_EQ(status(source.token()), Status::FOUND);
  EXPECT_EQ(status(source.token(seconds(0))), Status::TIMEOUT);
  source.cancel();
  EXPECT_EQ(status(source.token(seconds(0))), Status::CANCELLED);
}

}  // namespace
}  // namespace grid_path_planner::base
