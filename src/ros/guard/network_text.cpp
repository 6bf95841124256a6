#include "ros/guard/network_text.h"

#include <algorithm>

#include "base/plain_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::checkPlainText;
using base::InputError;

namespace {

bool isQuoting(unsigned char byte) {
  return byte == '"' || byte == '\'' || byte == '$' || byte == '`' || byte == '\\';
}

}  // namespace

void checkNetworkText(const std::string& what, const std::string& text, std::size_t longest) {
  checkPlainText(what, text, longest);
  if (std::any_of(text.begin(), text.end(), isQuoting))
    throw InputError(what + " must not hold quotes, dollar signs, backquotes or backslashes");
}

std::string printable(const std::string& text) {
  try {
    checkNetworkText("text", text);
    return text;
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace grid_path_planner::nodes
