// Whether the measurements of one source contradict the pose, by the odds of what became of them.
//
//   contradiction.add(stamp, Agreement::CONTRADICTS_AGAIN);
//   if (contradiction.lasts(now)) warn();
//
// Two hypotheses: the pose is right, and the source errs now and then; or one of the two is wrong for good. Each
// measurement adds the logarithm of how much likelier it is under the second (a cumulative sum, never below 0). What
// comes more often than once a second counts by the time that it stands for: errors of an instant are of one cause.
//
// The sum does not ask the covariance of a pose how well that is known: one that is begun anew by each
// contradiction is sure of itself each time.
#pragma once

#include <optional>

#include "localization/measurement.h"

namespace grid_path_planner::localization {

enum class Agreement {
  CONFIRMS,           // it lies where the pose lets expect it
  CONFIRMS_NEW,       // it does, shortly after a part of the pose began anew
  CONTRADICTS,        // it does not
  CONTRADICTS_AGAIN,  // nor did the last one, by the same deviation
  BEGINS_ANEW,        // as many such as begin the pose anew
};

class Contradiction {
 public:
  // Of a stamp that is not before the last one.
  void add(Stamp stamp, Agreement agreement);

  // From odds of 1000 on, until as much has confirmed the pose as contradicted it; or from odds of 10 on, two contradictions
  // in a row, while no other measurement has come for 2 s.
  bool lasts(Stamp now) const;
  // The newest is not older than `seconds`, and the last ones are not contradicted by more than an outlier.
  bool confirms(Stamp now, double seconds) const;
  // One has confirmed the pose in the last `seconds`.
  bool hasConfirmed(Stamp now, double seconds) const;

 private:
  double odds_ = 0.0;
  bool lasts_ = false;
  std::optional<Stamp> heard_, confirmed_;  // the newest
};

}  // namespace grid_path_planner::localization
