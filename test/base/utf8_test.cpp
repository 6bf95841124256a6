#include "base/utf8.h"

#include <gtest/gtest.h>

namespace grid_path_planner::base {
namespace {

std::string encoded(std::uint32_t code) {
  const auto byte = [](std::uint32_t bits) { return static_cast<char>(bits); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 63))};
  if (code < 0x10000)
    return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 63)), byte(0x80 | (code & 63))};
  return {byte(0xf0 | code >> 18), byte(0x80 | (code >> 12 & 63)), byte(0x80 | (code >> 6 & 63)),
          byte(0x80 | (code & 63))};
}

TEST(Utf8Law, EachCharacterIsAsLongAsItIsWritten) {
  for (std::uint32_t code = 0; code < 0x120000; ++code) {
    const std::string text = encoded(code);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    const std::size_t expected = surrogate || code > 0x10ffff ? 0 : text.size();
    ASSERT_EQ(characterBytes(text, 0), expected) << code;
    ASSERT_EQ(characterBytes("a" + text + "b", 1), expected) << code;
    if (text.size() > 1) {
      ASSERT_EQ(characterBytes(text.substr(0, text.size() - 1), 0), 0u) << code;
      ASSERT_EQ(characterBytes(text, 1), 0u) << code;
    }
  }
}

TEST(Utf8, OverlongFormsAreNone) {
  for (const char* text :
       {"\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xfe", "\xff"})
    EXPECT_EQ(characterBytes(text, 0), 0u) << text;
  EXPECT_EQ(characterBytes("", 0), 0u);
}

}  // namespace
}  // namespace grid_path_planner::base
