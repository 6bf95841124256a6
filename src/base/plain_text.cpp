#include "base/plain_text.h"

#include <algorithm>

#include "base/utf8.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {

namespace {

bool isControlByte(unsigned char byte) {
  return byte < 0x20 || byte == 0x7f;
}

// Whether the character of `bytes` bytes is a control character: U+0080 to U+009F have two.
bool isControlCharacter(const std::string& text, std::size_t at, std::size_t bytes) {
  if (bytes == 1) return isControlByte(static_cast<unsigned char>(text[at]));
  return text[at] == '\xc2' && static_cast<unsigned char>(text[at + 1]) < 0xa0;
}

bool isPlainUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = characterBytes(text, at);
    if (bytes == 0 || isControlCharacter(text, at, bytes)) return false;
    at += bytes;
  }
  return true;
}

std::string cleanedCharacter(const std::string& text, std::size_t at, std::size_t bytes) {
  if (bytes == 0) return "?";
  return isControlCharacter(text, at, bytes) ? " " : text.substr(at, bytes);
}

}  // namespace

void checkPlainText(const std::string& what, const std::string& text, std::size_t longest) {
  if (text.size() > longest)
    throw InputError(what + " has " + std::to_string(text.size()) + " bytes, expected at most " +
                     std::to_string(longest));
  if (std::any_of(text.begin(), text.end(), isControlByte))
    throw InputError(what + " must not hold control characters");
  if (!isPlainUtf8(text)) throw InputError(what + " must be UTF-8 without control characters");
}

std::string cleanedText(const std::string& text, std::size_t longest) {
  std::string cleaned;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = characterBytes(text, at);
    const std::string next = cleanedCharacter(text, at, bytes);
    if (cleaned.size() + next.size() > longest) break;
    cleaned += next;
    at += std::max<std::size_t>(bytes, 1);
  }
  return cleaned;
}

}  // namespace grid_path_planner::base
