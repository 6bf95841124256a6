#include "ros/messages/wrapped_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

namespace grid_path_planner::nodes {
namespace {

TEST(WrappedText, BreaksAtSpaces) {
  EXPECT_EQ(wrappedText("the door at (3, 1) is 0.5 m wide", 12),
            "the door at\n(3, 1) is\n0.5 m wide");
  EXPECT_EQ(wrappedText("short", 12), "short");
  EXPECT_EQ(wrappedText("", 12), "");
  EXPECT_EQ(wrappedText("a verylongwordindeed b", 5), "a\nverylongwordindeed\nb");
}

// Laws: but for the breaks the text stays, and a line is too long only where it is one word.
TEST(WrappedText, LosesNothing) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> letter(0, 4), length(0, 60);
  for (int round = 0; round < 5000; ++round) {
    std::string text;
    for (int i = length(random); i > 0; --i) text += letter(random) == 0 ? ' ' : 'x';
    std::string wrapped = wrappedText(text, 10);
    std::istringstream lines(wrapped);
    for (std::string line; std::getline(lines, line);)
      ASSERT_TRUE(line.size() <= 10 || line.find(' ') == std::string::npos) << wrapped;
    std::replace(wrapped.begin(), wrapped.end(), '\n', ' ');
    ASSERT_EQ(wrapped, text);
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
