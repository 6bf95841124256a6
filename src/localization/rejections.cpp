#include "localization/rejections.h"

#include <algorithm>

namespace grid_path_planner::localization {

namespace {

constexpr double kLongestBetween = 1.0;  // s

}  // namespace

int Rejections::add(Stamp stamp, const Deviation& deviation, double drift, double limit) {
  const auto difference = (deviation.offset - last_.offset).array();
  const auto variance = (deviation.variance + last_.variance).array();
  const double seconds = secondsBetween(stamp_, stamp);
  const auto agreeAfter = [&](double between) {
    return (difference.square() / (variance + drift * between)).sum() <= limit;
  };
  count_ = agreeAfter(seconds) ? count_ + 1 : 1;
  is_alike_ = is_any_ && agreeAfter(std::min(seconds, kLongestBetween));
  is_any_ = true;
  stamp_ = stamp;
  last_ = deviation;
  return count_;
}

}  // namespace grid_path_planner::localization
