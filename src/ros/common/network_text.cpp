#include "ros/common/network_text.h"

#include <algorithm>

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

// How many bytes follow the first one of a character in UTF-8; -1 where none can begin so.
int bytesAfter(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xc2 && first < 0xe0) return 1;
  if (first >= 0xe0 && first < 0xf0) return 2;
  if (first >= 0xf0 && first < 0xf5) return 3;
  return -1;
}

// Also without the control characters 0x80 to 0x9f, which begin escape sequences of terminals.
bool isUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const int more = bytesAfter(first);
    if (more < 0 || at + static_cast<std::size_t>(more) >= text.size()) return false;
    for (int i = 1; i <= more; ++i)
      if ((static_cast<unsigned char>(text[at + static_cast<std::size_t>(i)]) & 0xc0) != 0x80)
        return false;
    if (first == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0) return false;
    at += static_cast<std::size_t>(more) + 1;
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
