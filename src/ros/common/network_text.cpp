#include "ros/common/network_text.h"

#include <algorithm>

#include "base/utf8.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;

namespace {

bool isControl(unsigned char byte) {
  return byte < 0x20 || byte == 0x7f;
}

bool isQuoting(unsigned char byte) {
  return byte == '"' || byte == '\'' || byte == '$' || byte == '`' || byte == '\\';
}

// Also without the control characters 0x80 to 0x9f, which begin escape sequences of terminals.
bool isUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = base::characterBytes(text, at);
    if (bytes == 0) return false;
    const bool control = text[at] == '\xc2' && static_cast<unsigned char>(text[at + 1]) < 0xa0;
    if (control) return false;
    at += bytes;
  }
  return true;
}

}  // namespace

void checkPlainText(const std::string& what, const std::string& text, std::size_t longest) {
  if (text.size() > longest)
    throw InputError(what + " has " + std::to_string(text.size()) + " bytes, expected at most " +
                     std::to_string(longest));
  if (std::any_of(text.begin(), text.end(), isControl))
    throw InputError(what + " must not hold control characters");
  if (!isUtf8(text)) throw InputError(what + " must be UTF-8 without control characters");
}

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
