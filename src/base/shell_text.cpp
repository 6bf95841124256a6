#include "base/shell_text.h"

#include <algorithm>
#include <cstring>

namespace grid_path_planner::base {

namespace {

// In every locale.
bool isPlain(char letter) {
  constexpr char kPlain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+,";
  return letter != '\0' && std::strchr(kPlain, letter) != nullptr;
}

}  // namespace

std::string shellWord(const std::string& text) {
  if (!text.empty() && std::all_of(text.begin(), text.end(), isPlain)) return text;
  std::string word = "'";
  for (const char letter : text)
    word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + '\'';
}

}  // namespace grid_path_planner::base
