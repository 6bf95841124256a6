#include "ros/guard/network_text.h"

#include <gtest/gtest.h>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using test::errorText;

std::string refusal(const std::string& text) {
  return errorText([&] { checkNetworkText("the frame", text); });
}

TEST(NetworkText, NamesOfFramesPass) {
  for (const char* name :
       {"map", "/map", "robot_1/base_link", "camera link-2.0", "na\xc3\xafve", ""})
    EXPECT_EQ(refusal(name), "") << name;
  EXPECT_EQ(refusal(std::string(256, 'a')), "");
}

// A map whose frame was $(touch /tmp/x) came to stand in a file that a shell read.
TEST(NetworkText, WhatAShellOrATerminalWouldReadIsRefusedUnquoted) {
  for (const char* name :
       {"$(touch x)", "`touch x`", "a\"b", "a'b", "a\\b", "a\nb", "a\rb", "\x1b[2J", "a\x7f",
        "\xc2\x9b"
        "2J",
        "\x9b"
        "2J",
        "\xff", "\xe2\x82", "\xc0\xaf"}) {
    EXPECT_NE(refusal(name), "") << name;
    EXPECT_EQ(refusal(name).find(name), std::string::npos) << refusal(name);
  }
  EXPECT_NE(refusal(std::string("a\0b", 3)), "");
  EXPECT_EQ(refusal(std::string(257, 'a')), "the frame has 257 bytes, expected at most 256");
}

}  // namespace
}  // namespace grid_path_planner::nodes
