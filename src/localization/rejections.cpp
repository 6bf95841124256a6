#include "localization/rejections.h"

namespace grid_path_planner::localization {

int Rejections::add(Stamp stamp, const Deviation& deviation, double drift, double limit) {
  const auto difference = (deviation.offset - last_.offset).array();
  const auto variance = (deviation.variance + last_.variance).array();
  const double between = drift * secondsBetween(stamp_, stamp);
  const bool agrees = (difference.square() / (variance + between)).sum() <= limit;
  count_ = agrees ? count_ + 1 : 1;
  stamp_ = stamp;
  last_ = deviation;
  return count_;
}

}  // namespace grid_path_planner::localization
