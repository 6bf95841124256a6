#include "panel/shown_text.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace grid_path_planner::panel {
namespace {

constexpr double kYear = 365.0 * 86400.0;  // s

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

// Bytes of the sequence that `first` begins; 0 where none begins so.
std::size_t sequenceLength(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

Character characterAt(const std::string& text, std::size_t i) {
  const auto first = static_cast<unsigned char>(text[i]);
  const std::size_t length = sequenceLength(first);
  if (length == 0 || i + length > text.size()) return {};
  Character found{length == 1 ? first : first & (0xFFU >> (length + 1)), length, true};
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[i + k]);
    if ((next & 0xC0U) != 0x80U) return {};
    found.code = (found.code << 6U) | (next & 0x3FU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = found.code >= 0xD800 && found.code < 0xE000;
  if (found.code < kLeast[length] || found.code > 0x10FFFF || surrogate) return {};
  return found;
}

bool isControl(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x200B && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

std::string formatted(const char* format, int first, int second) {
  char text[64];
  std::snprintf(text, sizeof(text), format, first, second);
  return text;
}

}  // namespace

std::string shownText(const std::string& text, std::size_t longest) {
  std::string shown;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    if (count == longest) return shown + "...";
    const Character character = characterAt(text, i);
    if (!character.valid)
      shown += '?';
    else if (isControl(character.code))
      shown += ' ';
    else
      shown.append(text, i, character.bytes);
    i += character.bytes;
  }
  return shown;
}

std::string shownNumber(double value) {
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string shownDuration(double seconds) {
  if (!(seconds >= 0.0 && seconds < kYear)) return "-";
  const int whole = static_cast<int>(std::lround(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return formatted("%d min %d s", whole / 60, whole % 60);
  return formatted("%d h %d min", whole / 3600, whole % 3600 / 60);
}

}  // namespace grid_path_planner::panel
