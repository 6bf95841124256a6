#include "support/mutation.h"

#include <algorithm>

namespace grid_path_planner::test {
namespace {

std::size_t below(std::size_t limit, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
}

// Letters that mean something in one format or another, and any byte.
char anyLetter(std::mt19937& random) {
  constexpr char kTelling[] = "0123456789-+.eE,:;[]{}'\"#&*!|>?%@ \t\r\n\\\x7f\xff";
  if (below(4, random) == 0) return static_cast<char>(below(256, random));
  return kTelling[below(sizeof kTelling - 1, random)];
}

void injure(std::string& content, std::mt19937& random) {
  const std::size_t at = below(content.size(), random);
  const std::size_t length = std::min<std::size_t>(content.size() - at, 1 + below(16, random));
  switch (below(6, random)) {
    case 0:
      content[at] = anyLetter(random);
      break;
    case 1:
      content.insert(at, 1 + below(3, random), anyLetter(random));
      break;
    case 2:
      content.erase(at, length);
      break;
    case 3:
      content.insert(at, content.substr(at, length));
      break;
    case 4:
      content.resize(at);
      break;
    default: {
      const std::size_t digit = content.find_first_of("0123456789", at);
      if (digit != std::string::npos) content[digit] = static_cast<char>('0' + below(10, random));
    }
  }
}

}  // namespace

std::string mutated(const std::string& content, std::mt19937& random) {
  std::string damaged = content;
  const std::size_t injuries = 1 + below(4, random);
  for (std::size_t i = 0; i < injuries && !damaged.empty(); ++i) injure(damaged, random);
  return damaged;
}

}  // namespace grid_path_planner::test
