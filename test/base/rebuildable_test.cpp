// A value that is changed in place, and begun anew after an error between.
#include "base/rebuildable.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace grid_path_planner::base {
namespace {

struct Answer : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Values = std::vector<int>;

TEST(Rebuildable, IsMadeOnceAndChangedInPlace) {
  int made = 0;
  Rebuildable<Values> values([&] {
    ++made;
    return Values{1};
  });
  EXPECT_EQ(values.get(), nullptr);
  const int* first = values.change([](Values& all) { return all.data(); });
  EXPECT_EQ(values.change([](Values& all) { return all.data(); }), first);
  EXPECT_EQ(made, 1);
}

TEST(Rebuildable, AfterAnErrorItIsBegunAnew) {
  Rebuildable<Values, Answer> values([] { return Values{1}; });
  const auto fail = [](Values& all) {
    all.push_back(2);
    throw std::runtime_error("in between");
  };
  EXPECT_THROW(values.change(fail), std::runtime_error);
  EXPECT_EQ(values.get(), nullptr);
  EXPECT_EQ(values.change([](Values& all) { return all; }), Values{1});
}

TEST(Rebuildable, AnAnswerLeavesItWhole) {
  Rebuildable<Values, Answer> values([] { return Values{1}; });
  const auto answer = [](Values& all) {
    all.push_back(2);
    throw Answer("there is no path");
  };
  EXPECT_THROW(values.change(answer), Answer);
  EXPECT_EQ(values.change([](Values& all) { return all.size(); }), 2U);
}

TEST(Rebuildable, AMakingThatFailsIsTriedAgain) {
  bool fails = true;
  Rebuildable<Values> values([&] {
    if (fails) throw std::runtime_error("no memory");
    return Values{1};
  });
  EXPECT_THROW(values.change([](Values&) {}), std::runtime_error);
  fails = false;
  EXPECT_EQ(values.change([](Values& all) { return all.size(); }), 1U);
}

}  // namespace
}  // namespace grid_path_planner::base
