// Texts and numbers that come from other nodes, as the panel shows them.
//
//   use(shownText(message, 300));   // one line without control characters
//   use(shownNumber(12.346));       // "12.35", "1.2e+300", "-"
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::panel {

// `text` in one line of UTF-8: each control character (line breaks, escapes, DEL, those that turn the
// direction of writing) becomes a space, what is no UTF-8 a question mark; more than `longest`
// characters are cut, with "..." at the end.
std::string shownText(const std::string& text, std::size_t longest);

// With four significant digits; "-" for what is no number, "inf" for infinity.
std::string shownNumber(double value);

// "12 s", "3 min 20 s", "2 h 5 min"; "-" for what is no time, negative or above a year.
std::string shownDuration(double seconds);

}  // namespace grid_path_planner::panel
