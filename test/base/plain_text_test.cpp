#include "base/plain_text.h"

#include <gtest/gtest.h>

#include <string>

#include "support/error_text.h"

namespace grid_path_planner::base {
namespace {

std::string complaint(const std::string& text) {
  return test::errorText([&] { checkPlainText("the name", text, 8); });
}

TEST(PlainText, IsUtf8WithoutControlCharacters) {
  EXPECT_EQ(complaint("rock 'a'"), "");
  EXPECT_EQ(complaint("\xd1\x84"), "");
  EXPECT_EQ(complaint(""), "");
  EXPECT_EQ(complaint("123456789"), "the name has 9 bytes, expected at most 8");
  for (const char* text : {"a\x1b[2J", "a\nb", "\x7f"})
    EXPECT_EQ(complaint(text), "the name must not hold control characters");
  for (const char* text : {"\xff", "\xd1",
                           "a\xc2\x9b"
                           "2J"})
    EXPECT_EQ(complaint(text), "the name must be UTF-8 without control characters");
}

TEST(PlainText, IsCleanedCharacterByCharacter) {
  EXPECT_EQ(cleanedText("a\x1b[2J\r\nb", 100), "a [2J  b");
  EXPECT_EQ(cleanedText("\xc2\x9b"
                        "2J \xd1\x84 \xff.",
                        100),
            " 2J \xd1\x84 ?.");
  EXPECT_EQ(cleanedText("abc\xd1\x84"
                        "d",
                        4),
            "abc")
      << "no half of a character";
  EXPECT_EQ(cleanedText("", 4), "");
}

TEST(PlainText, ThatIsPlainStaysAsItIs) {
  const std::string text = "world.sdf: \"rock\" is no mesh \xd1\x84";
  EXPECT_EQ(cleanedText(text, text.size()), text);
}

}  // namespace
}  // namespace grid_path_planner::base
