#include "ros/messages/wrapped_text.h"

namespace grid_path_planner::nodes {

std::string wrappedText(const std::string& text, std::size_t width) {
  std::string wrapped = text;
  std::size_t begin = 0, space = std::string::npos;  // of the line; its last space
  for (std::size_t i = 0; i <= wrapped.size(); ++i) {
    if (i < wrapped.size() && wrapped[i] != ' ') continue;
    if (i - begin > width && space != std::string::npos) {
      wrapped[space] = '\n';
      begin = space + 1;
    }
    space = i;
  }
  return wrapped;
}

}  // namespace grid_path_planner::nodes
