#include "grid_path_planner/base/option_text.h"

#include <algorithm>
#include <exception>
#include <numeric>

namespace grid_path_planner::base {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

double numberFromText(const std::string& name, const std::string& text) {
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value))
    throw InputError(name + " needs a finite number, got '" + text + "'");
  return value;
}

bool truthFromText(const std::string& name, const std::string& text) {
  if (text == "true" || text == "1" || text == "yes") return true;
  if (text == "false" || text == "0" || text == "no") return false;
  throw InputError(name + " needs true or false, got '" + text + "'");
}

std::string closestName(const std::string& name, const std::vector<std::string>& known) {
  const auto nearer = [&](const std::string& a, const std::string& b) {
    return editDistance(name, a) < editDistance(name, b);
  };
  const auto best = std::min_element(known.begin(), known.end(), nearer);
  return best != known.end() && editDistance(name, *best) <= name.size() / 2 ? *best : "";
}

std::string configName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace grid_path_planner::base
