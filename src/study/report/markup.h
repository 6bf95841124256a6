// Text inside HTML, SVG and scripts.
#pragma once

#include <string>

namespace grid_path_planner::study {

// As text of an element, or as an attribute in double quotes, of HTML or XML: read back, it is the text. What no XML may
// hold, control characters and what is not UTF-8, becomes U+FFFD.
std::string escaped(const std::string& text);

// JSON for a script element: nothing in it ends the element.
std::string scriptSafe(const std::string& json);

}  // namespace grid_path_planner::study
