#include "panel/shown_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "grid_path_planner/planners/planner_factory.h"
#include "panel/planner_colours.h"

namespace grid_path_planner::panel {
namespace {

TEST(ShownText, KeepsTextsAndTakesControlCharactersOut) {
  EXPECT_EQ(shownText("Tür bei 3 m × 2 m", 100), "Tür bei 3 m × 2 m");
  EXPECT_EQ(shownText("a\nb\x1b[31mc\x7f", 100), "a b [31mc ");
  EXPECT_EQ(shownText("left\u202Eright", 100), "left right");
  EXPECT_EQ(shownText(std::string("a\0b", 3), 100), "a b");
}

TEST(ShownText, WhatIsNoUtf8IsAQuestionMark) {
  EXPECT_EQ(shownText("\xC0\xAF", 100), "??");            // an overlong slash
  EXPECT_EQ(shownText("\xED\xA0\x80", 100), "???");       // a surrogate
  EXPECT_EQ(shownText("\xF4\x90\x80\x80", 100), "????");  // beyond Unicode
  EXPECT_EQ(shownText("a\xE2\x82", 100), "a??");          // cut in the middle
}

TEST(ShownText, LongTextsAreCutBetweenCharacters) {
  EXPECT_EQ(shownText("äöü", 2), "äö...");
  EXPECT_EQ(shownText("äöü", 3), "äöü");
  EXPECT_LT(shownText(std::string(1 << 20, 'x'), 400).size(), 410U);
}

// A law: of any bytes at most `longest` characters and no control character remain, and what is
// shown once is shown again as it is.
TEST(ShownText, AnyBytes) {
  std::mt19937 random(17);
  std::uniform_int_distribution<int> byte(0, 255), length(0, 40);
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (int i = length(random); i > 0; --i) text += static_cast<char>(byte(random));
    const std::string shown = shownText(text, 100);
    for (const char c : shown) ASSERT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == 0x7f);
    ASSERT_EQ(shownText(shown, 100), shown);
  }
}

TEST(ShownNumber, HugeAndStrangeOnesStayShort) {
  EXPECT_EQ(shownNumber(12.3456), "12.35");
  EXPECT_EQ(shownNumber(1.7e308), "1.7e+308");
  EXPECT_EQ(shownNumber(std::nan("")), "-");
  EXPECT_EQ(shownNumber(std::numeric_limits<double>::infinity()), "inf");
}

TEST(ShownDuration, InWords) {
  EXPECT_EQ(shownDuration(0.4), "0 s");
  EXPECT_EQ(shownDuration(59.4), "59 s");
  EXPECT_EQ(shownDuration(59.6), "1 min 0 s");
  EXPECT_EQ(shownDuration(7500.0), "2 h 5 min");
  EXPECT_EQ(shownDuration(-1.0), "-");
  EXPECT_EQ(shownDuration(std::nan("")), "-");
  EXPECT_EQ(shownDuration(1e300), "-");
}

TEST(PlannerColours, EveryPlannerHasOneOfItsOwn) {
  const auto number = [](const std::string& planner) {
    const Colour colour = colourOf(planner);
    return (colour.red * 256 + colour.green) * 256 + colour.blue;
  };
  std::set<int> seen = {number("a planner of tomorrow")};
  for (const std::string& name : planners::plannerNames())
    EXPECT_TRUE(seen.insert(number(name)).second) << name;
}

}  // namespace
}  // namespace grid_path_planner::panel
