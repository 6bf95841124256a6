// A text as editors of other systems leave it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grid_path_planner::test {

inline std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// With a name each. `gap` separates words, and may be a tab.
inline std::vector<std::pair<std::string, std::string>> variantsOf(const std::string& text,
                                                                   const std::string& gap = " ") {
  const std::string wide = gap.substr(0, gap.size() - 1) + "\t";
  std::vector<std::pair<std::string, std::string>> variants = {
      {"as it is", text},
      {"CR LF", replacedAll(text, "\n", "\r\n")},
      {"a byte order mark", "\xef\xbb\xbf" + text},
      {"spaces at the end of lines", replacedAll(text, "\n", "  \n")},
      {"tabs at the end of lines", replacedAll(text, "\n", "\t\n")},
      {"tabs for spaces", replacedAll(text, gap, wide)},
      {"all of them", "\xef\xbb\xbf" + replacedAll(replacedAll(text, gap, wide), "\n", " \t\r\n")}};
  return variants;
}

}  // namespace grid_path_planner::test
