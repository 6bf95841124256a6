// A filter that takes measurements in any order.
//
//   LaggedFilter filter(options, Start::AT_FIX);
//   filter.add(measurement);                                   // late ones too
//   if (filter.started()) use(filter.snapshotAt(now).estimate);
//
// It keeps the measurements of the last `history` seconds with the snapshot after each. One that comes
// late is put in its place, and all after it are applied again.
//
// Guaranteed: the same measurements give the same estimate to the last bit, in whatever order they
// come, as long as none is refused: as older than the history, or as the second of its source and stamp.
// Memory and time per measurement are bounded by the history, and by kMostEvents whatever comes: of more the oldest leave
// the history early. Not guaranteed: that a measurement
// stamped in the future is noticed; it makes others too old, and must be kept away.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "localization/filter_step.h"

namespace grid_path_planner::localization {

constexpr std::size_t kMostEvents = 20'000;  // some 5 KB each; 5 s of 4000 measurements in a second

struct SourceCounts {
  std::uint64_t taken = 0, gated = 0, resets = 0;
};

class LaggedFilter {
 public:
  struct Event {
    Measurement measurement;
    Outcome outcome = {};
    FilterSnapshot after = {};
  };

  LaggedFilter(const FilterOptions& options, Start start);

  // What became of it, for now: an earlier measurement that comes later may change that.
  Verdict add(const Measurement& measurement);

  // Other options, from the next measurement on.
  void use(const FilterOptions& options);

  // Everything but the options is forgotten.
  void reset();

  // What is known of the IMU's heading, until the next reset(). Precondition: empty().
  void beginWith(const KnownHeading& heading) { base_.heading = heading; }

  bool started() const;
  // Of the newest measurement. Precondition: there is one.
  Stamp newest() const { return events_.back().measurement.stamp; }
  bool empty() const { return events_.empty(); }

  // After the newest measurement.
  FilterSnapshot snapshot() const { return empty() ? base_ : events_.back().after; }
  // After the last measurement at or before `stamp`, moved on to it; where that is before the history, the oldest that
  // there is.
  FilterSnapshot snapshotAt(Stamp stamp) const;
  // Of the body, rad/s, without the gyro's bias.
  Eigen::Vector3d rateOf(const FilterSnapshot& snapshot) const;

  // Those of the history, oldest first.
  const std::deque<Event>& events() const { return events_; }
  // Of all that ever was applied.
  SourceCounts counts(Source source) const;

 private:
  void applyFrom(std::size_t index);
  std::size_t firstAffected(std::size_t index) const;
  const TimedImu* nextImu(std::size_t index, TimedImu& storage) const;
  void trim();

  FilterOptions options_;
  Start start_;
  FilterStep step_;
  FilterSnapshot base_;   // before the first of events_
  bool trimmed_ = false;  // events have left the history
  std::deque<Event> events_;
  std::array<SourceCounts, kSources> counted_{};  // of those that have left the history
};

}  // namespace grid_path_planner::localization
