#include "study/report/table.h"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace grid_path_planner::study {
namespace {

std::string withCommas(std::string digits) {
  const std::size_t first = digits[0] == '-' ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) {
    at -= 3;
    digits.insert(at, ",");
  }
  return digits;
}

std::string csvCell(const TableCell& cell) {
  if (cell.number) {
    std::ostringstream out;
    out.precision(12);
    out << *cell.number;
    return out.str();
  }
  if (cell.text.find_first_of(",\"\n") == std::string::npos) return cell.text;
  std::string quoted = "\"";
  for (const char letter : cell.text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + '"';
}

}  // namespace

TableCell::TableCell(double number, int digits) : text(shownNumber(number, digits)) {
  if (!std::isnan(number)) this->number = number;
}

std::string shownNumber(double number, int digits) {
  if (std::isinf(number)) return number > 0 ? "∞" : "−∞";
  if (std::isnan(number)) return "–";
  char text[64];
  const double size = std::abs(number);
  if (number == std::floor(number) && size < 1e15) {
    std::snprintf(text, sizeof text, "%.0f", number);
    return withCommas(text);
  }
  const int before = size < 1.0 ? 0 : static_cast<int>(std::log10(size)) + 1;
  if (before >= digits) {
    std::snprintf(text, sizeof text, "%.0f", number);
    return withCommas(text);
  }
  if (size >= 1e-4) {
    const int zeros = size < 1.0 ? static_cast<int>(-std::floor(std::log10(size))) - 1 : 0;
    std::snprintf(text, sizeof text, "%.*f", digits - before + zeros, number);
    return text;
  }
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

std::string csvOf(const Table& table) {
  std::string out;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    out += (i > 0 ? "," : "") + csvCell(table.columns[i]);
  out += "\r\n";
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out += (i > 0 ? "," : "") + csvCell(row[i]);
    out += "\r\n";
  }
  return out;
}

}  // namespace grid_path_planner::study
