// Commands that are printed are copied into a shell.
#include "base/shell_text.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

namespace grid_path_planner::base {
namespace {

// What `sh` makes of the words of a command.
std::string readByShell(const std::string& words) {
  const std::string script = "printf '%s\\0' " + words;
  // Standard input: a script with any bytes.
  const std::string out = testing::TempDir() + "shell_text_" + std::to_string(getpid());
  FILE* shell = popen(("sh > " + out).c_str(), "w");
  if (shell == nullptr) return "no shell";
  std::fwrite(script.data(), 1, script.size(), shell);
  if (pclose(shell) != 0) return "the shell failed";
  std::string read;
  std::array<char, 4096> piece{};
  FILE* file = std::fopen(out.c_str(), "rb");
  if (file == nullptr) return "no output";
  while (const std::size_t bytes = std::fread(piece.data(), 1, piece.size(), file))
    read.append(piece.data(), bytes);
  std::fclose(file);
  std::remove(out.c_str());
  return read;
}

TEST(ShellText, PlainNamesStayAsTheyAre) {
  EXPECT_EQ(shellWord("config/study_1-a.yaml"), "config/study_1-a.yaml");
  EXPECT_EQ(shellWord("my study.yaml"), "'my study.yaml'");
  EXPECT_EQ(shellWord(""), "''");
  EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
}

// A study in a folder named by somebody else: its report said to run what would have deleted files.
TEST(ShellTextLaw, AShellReadsBackTheTextAndRunsNothing) {
  std::vector<std::string> texts = {"a b",  "$(echo run)", "`echo run`", "a\nb", "\n",
                                    "it's", "\"",          "\\",         "a;b",  "~",
                                    "*",    "#x",          "a=b",        "!x",   ""};
  std::mt19937 random(16);
  const std::string letters = "ab '\"\\$(`);&|<>*?[]#~=%!{}\n\t\r\x1b\x7f\xc3\xa4\xff";
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t length = random() % 12; length > 0; --length)
      text += letters[random() % letters.size()];
    texts.push_back(text);
  }
  std::string words, expected;
  for (const std::string& text : texts) {
    words += ' ' + shellWord(text);
    expected += text + '\0';
  }
  EXPECT_EQ(readByShell(words), expected);
}

}  // namespace
}  // namespace grid_path_planner::base
