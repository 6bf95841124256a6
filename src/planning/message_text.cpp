#include "planning/message_text.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace grid_path_planner::planning {

namespace {

constexpr double kRoundingOfLengths = 1e-6;  // m

}  // namespace

std::string positionText(const Eigen::Vector2d& position) {
  std::ostringstream out;
  out << std::setprecision(6) << '(' << position.x() << ", " << position.y() << ')';
  return out.str();
}

std::string metresText(double length) {
  std::ostringstream out;
  out << std::setprecision(4) << length << " m";
  return out.str();
}

std::string headingText(double yaw) {
  const double degrees = std::round(std::remainder(yaw, 2.0 * M_PI) * 180.0 / M_PI);
  return "heading " + std::to_string(static_cast<int>(degrees)) + " deg";
}

std::string unreachableText(const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                            double tolerance) {
  std::string text = "no path leads from " + positionText(start) + " to " + positionText(goal);
  if (tolerance > 0.0) text += " or within " + metresText(tolerance) + " of it";
  return text;
}

std::string unknownNote(const path::ClassLengths& lengths) {
  if (lengths.unknown_m <= kRoundingOfLengths) return "";
  return metresText(lengths.unknown_m) + " of it through unknown cells";
}

void addNote(std::string& message, const std::string& note) {
  if (!note.empty()) message += (message.empty() ? "" : "; ") + note;
}

}  // namespace grid_path_planner::planning
