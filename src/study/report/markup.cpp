#include "study/report/markup.h"

#include "base/utf8.h"

namespace grid_path_planner::study {
namespace {

constexpr char kReplacement[] = "\xef\xbf\xbd";  // U+FFFD

// One character of UTF-8.
std::string escapedCharacter(const std::string& character) {
  if (character.size() > 1)  // U+FFFE and U+FFFF are no characters
    return character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf" ? kReplacement : character;
  switch (character.front()) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\t':  // a reader of XML makes spaces of these where they stand in attributes
      return "&#9;";
    case '\n':
      return "&#10;";
    case '\r':
      return "&#13;";
    default:
      return static_cast<unsigned char>(character.front()) < 0x20 || character.front() == 0x7f
                 ? kReplacement
                 : character;
  }
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = base::characterBytes(text, at);
    out += bytes == 0 ? kReplacement : escapedCharacter(text.substr(at, bytes));
    at += bytes == 0 ? 1 : bytes;
  }
  return out;
}

std::string scriptSafe(const std::string& json) {
  std::string out;
  for (const char letter : json)
    out += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
  return out;
}

}  // namespace grid_path_planner::study
