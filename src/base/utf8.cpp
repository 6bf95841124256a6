#include "base/utf8.h"

namespace grid_path_planner::base {

namespace {

// A first byte, with how many follow it, and the limits of the second.
struct Form {
  unsigned char first, last;
  std::size_t more;
  unsigned char low, high;
};

// The well-formed sequences of the Unicode standard, table 3-7.
constexpr Form kForms[] = {
    {0x00, 0x7f, 0, 0x00, 0x00}, {0xc2, 0xdf, 1, 0x80, 0xbf}, {0xe0, 0xe0, 2, 0xa0, 0xbf},
    {0xe1, 0xec, 2, 0x80, 0xbf}, {0xed, 0xed, 2, 0x80, 0x9f}, {0xee, 0xef, 2, 0x80, 0xbf},
    {0xf0, 0xf0, 3, 0x90, 0xbf}, {0xf1, 0xf3, 3, 0x80, 0xbf}, {0xf4, 0xf4, 3, 0x80, 0x8f}};

bool follows(const std::string& text, std::size_t at, const Form& form) {
  if (form.more >= text.size() - at) return false;
  for (std::size_t i = 1; i <= form.more; ++i) {
    const auto byte = static_cast<unsigned char>(text[at + i]);
    const unsigned char low = i == 1 ? form.low : 0x80, high = i == 1 ? form.high : 0xbf;
    if (byte < low || byte > high) return false;
  }
  return true;
}

}  // namespace

std::size_t characterBytes(const std::string& text, std::size_t at) {
  if (at >= text.size()) return 0;
  const auto first = static_cast<unsigned char>(text[at]);
  for (const Form& form : kForms)
    if (first >= form.first && first <= form.last)
      return follows(text, at, form) ? form.more + 1 : 0;
  return 0;
}

}  // namespace grid_path_planner::base
