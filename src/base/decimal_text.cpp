#include "grid_path_planner/base/decimal_text.h"

#include <limits>
#include <locale>
#include <sstream>

namespace grid_path_planner::base {

namespace {

// With so many digits, in scientific notation where the number is larger than they tell.
std::string rounded(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}

double readBack(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double value = 0.0;
  in >> value;
  return value;
}

}  // namespace

std::string decimalText(double value) {
  constexpr int kMostDigits = std::numeric_limits<double>::max_digits10;
  std::string scientific;  // 1e+01; preferred only where there is no 10
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    const std::string text = rounded(value, digits);
    if (readBack(text) != value) continue;
    if (text.find('e') == std::string::npos) return text;
    if (scientific.empty()) scientific = text;
  }
  return scientific.empty() ? rounded(value, kMostDigits) : scientific;
}

}  // namespace grid_path_planner::base
