#include "grid/float_decimal.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace grid_path_planner::grid {

double floatToDecimal(float value) {
  if (!std::isfinite(value)) return value;
  for (int digits = 1; digits <= std::numeric_limits<float>::max_digits10; ++digits) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    double decimal = 0.0;
    text >> decimal;
    if (static_cast<float>(decimal) == value) return decimal;
  }
  return value;
}

double printedFloatToDecimal(double value) {
  const bool fits = std::fabs(value) <= std::numeric_limits<float>::max();
  const bool is_float = fits && static_cast<double>(static_cast<float>(value)) == value;
  return is_float ? floatToDecimal(static_cast<float>(value)) : value;
}

}  // namespace grid_path_planner::grid
