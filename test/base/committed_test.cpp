// State that is changed as a whole: whatever throws in between, and whoever reads meanwhile.
#include "base/committed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace grid_path_planner::base {
namespace {

struct Settings {
  std::string name = "first";
  std::vector<int> values = {1, 2, 3};
  unsigned revision = 0;
};

TEST(Committed, AChangeIsSeenAsAWhole) {
  Committed<Settings> settings;
  const auto before = settings.get();
  settings.change([](Settings& next) {
    next.name = "second";
    ++next.revision;
  });
  EXPECT_EQ(before->name, "first") << "what is read stays";
  EXPECT_EQ(settings.get()->name, "second");
  EXPECT_EQ(settings.get()->revision, 1U);
  EXPECT_EQ(settings.get(), settings.get()) << "reading copies nothing";
}

TEST(Committed, AChangeThatThrowsLeavesNothingChanged) {
  Committed<Settings> settings;
  const auto before = settings.get();
  EXPECT_THROW(settings.change([](Settings& next) {
    next.name = "half";
    next.values.clear();
    throw std::runtime_error("no memory for the rest");
  }),
               std::runtime_error);
  EXPECT_EQ(settings.get(), before);
  EXPECT_EQ(before->name, "first");
  EXPECT_EQ(before->values.size(), 3U);
  settings.change([](Settings& next) { next.name = "second"; });
  EXPECT_EQ(settings.get()->name, "second") << "and the next one goes on";
}

// A value that cannot be copied now.
struct Fragile {
  Fragile() = default;
  Fragile(Fragile&&) = default;
  Fragile(const Fragile& other) : number(other.number) {
    if (number < 0) throw std::runtime_error("no copy");
  }
  int number = 0;
};

TEST(Committed, ACopyThatThrowsLeavesNothingChanged) {
  Fragile fragile;
  fragile.number = -1;
  Committed<Fragile> committed(std::move(fragile));
  bool called = false;
  EXPECT_THROW(committed.change([&](Fragile&) { called = true; }), std::runtime_error);
  EXPECT_FALSE(called);
  EXPECT_EQ(committed.get()->number, -1);
}

TEST(Committed, ChangesOfSeveralThreadsAllCountAndReadersSeeNoneInPart) {
  constexpr int kChanges = 2000;
  Committed<Settings> settings;
  std::atomic<bool> done{false};
  std::thread reader([&] {
    while (!done) {
      const auto now = settings.get();
      ASSERT_EQ(now->values.size(), 3U + now->revision % 5);
    }
  });
  const auto change = [&] {
    for (int i = 0; i < kChanges; ++i)
      settings.change([](Settings& next) {
        ++next.revision;
        next.values.assign(3 + next.revision % 5, 7);
      });
  };
  std::thread one(change), other(change);
  one.join();
  other.join();
  done = true;
  reader.join();
  EXPECT_EQ(settings.get()->revision, 2U * kChanges);
}

}  // namespace
}  // namespace grid_path_planner::base
