#include "localization/contradiction.h"

#include <algorithm>
#include <array>

namespace grid_path_planner::localization {

namespace {

// Logarithms of odds: of 100 measurements of a sound source and pose 95 confirm, 5 are outliers and one of them by what
// the last one was off; of a pose that is wrong, or a source half of whose measurements are, 50, 30 and 20 or more.
constexpr std::array<double, 5> kLikelier = {-1.0, -0.2, 1.2, 3.5, 3.5};
constexpr double kLasting = 6.9;  // 1000 to 1
constexpr double kLargest =
    10.0;  // so that a source is believed again in 8 s, one that began the pose anew in 40 s
constexpr double kOutlier = 2.0;                  // what one outlier adds, and less than two do
constexpr double kUnlikely = 2.3;                 // 10 to 1: two in a row
constexpr double kStanding = 2.0, kPeriod = 1.0;  // s

}  // namespace

void Contradiction::add(Stamp stamp, Agreement agreement) {
  const bool counts_alone = !heard_ || agreement == Agreement::BEGINS_ANEW;
  const double share =
      !counts_alone ? std::min(1.0, secondsBetween(*heard_, stamp) / kPeriod) : 1.0;
  heard_ = stamp;
  if (agreement <= Agreement::CONFIRMS_NEW) confirmed_ = stamp;
  odds_ = std::clamp(odds_ + share * kLikelier[static_cast<std::size_t>(agreement)], 0.0, kLargest);
  lasts_ = lasts_ ? odds_ > kOutlier : odds_ >= kLasting;
}

bool Contradiction::lasts(Stamp now) const {
  return lasts_ || (odds_ >= kUnlikely && heard_ && secondsBetween(*heard_, now) >= kStanding);
}

bool Contradiction::confirms(Stamp now, double seconds) const {
  return heard_ && secondsBetween(*heard_, now) <= seconds && odds_ <= kOutlier;
}

bool Contradiction::hasConfirmed(Stamp now, double seconds) const {
  return confirmed_ && secondsBetween(*confirmed_, now) <= seconds;
}

}  // namespace grid_path_planner::localization
