// Text inside HTML, SVG and scripts.
#pragma once

#include <string>

namespace grid_path_planner::study {

// With the special characters of HTML escaped.
inline std::string escaped(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '&')
      out += "&amp;";
    else if (letter == '<')
      out += "&lt;";
    else if (letter == '>')
      out += "&gt;";
    else if (letter == '"')
      out += "&quot;";
    else
      out += letter;
  }
  return out;
}

// JSON for a script element: nothing in it ends the element.
inline std::string scriptSafe(const std::string& json) {
  std::string out;
  for (const char letter : json)
    out += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
  return out;
}

}  // namespace grid_path_planner::study
