#include "localization/pose_doubt.h"

#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::localization {

namespace {

constexpr double kFlips = 3.0;  // s, without one that is right

bool isPose(Source source) {
  return source == Source::USBL || source == Source::MARKER;
}

// Whether fixes of another kind confirm the pose: what the source contradicts it by is its own error then. A marker tells
// all that the others do. An acoustic fix tells no heading: it overrules markers that are wrong now and then (flips), and
// none that never confirm.
bool isOverruled(Source source, const FilterSnapshot& snapshot, Stamp now,
                 const LocalizerOptions& options) {
  const auto of = [&](Source other) -> const Contradiction& {
    return snapshot.contradictions[static_cast<std::size_t>(other)];
  };
  const auto confirms = [&](Source other) {
    return of(other).confirms(now, longestSilence(other, options));
  };
  if (source == Source::MARKER)
    return of(Source::MARKER).hasConfirmed(now, kFlips) && confirms(Source::USBL);
  return confirms(Source::MARKER) || (source == Source::DEPTH && confirms(Source::USBL));
}

// Two in a row that were rejected and agree with each other. Those of acoustic and marker fixes stand until a fix is used;
// those of what comes all the time, as a heading, for input_timeout: its source may have been switched off.
bool isInDoubt(Source source, const FilterSnapshot& snapshot, Stamp now,
               const LocalizerOptions& options) {
  const Rejections& rejections = snapshot.rejections[static_cast<std::size_t>(source)];
  if (rejections.count() < 2) return false;
  return isPose(source) || secondsBetween(rejections.newest(), now) <= options.input_timeout;
}

PoseDoubt doubtBy(Source source, const FilterSnapshot& snapshot, bool lasts) {
  const auto& offset = snapshot.rejections[static_cast<std::size_t>(source)].last().offset;
  const bool is_velocity = source == Source::DVL || source == Source::COMMAND;
  return {source, lasts, is_velocity ? 0.0 : offset.head<3>().norm(),
          offset.tail<3>().norm() * 180.0 / M_PI};
}

std::string inHundredths(double value) {
  return base::decimalText(std::round(100.0 * value) / 100.0);
}

}  // namespace

std::optional<PoseDoubt> doubtOf(const FilterSnapshot& snapshot, Stamp now,
                                 const LocalizerOptions& options) {
  for (const Source source : {Source::USBL, Source::MARKER, Source::DEPTH, Source::HEADING})
    if (snapshot.contradictions[static_cast<std::size_t>(source)].lasts(now) &&
        !isOverruled(source, snapshot, now, options))
      return doubtBy(source, snapshot, true);
  for (int source = 0; source < kSources; ++source)
    if (isInDoubt(static_cast<Source>(source), snapshot, now, options))
      return doubtBy(static_cast<Source>(source), snapshot, false);
  return {};
}

std::string sentenceOf(const PoseDoubt& doubt) {
  std::string sentence = std::string(nameOf(doubt.source)) + " contradicts the pose";
  if (doubt.lasts) sentence += " for good";
  if (doubt.metres > 0.0) sentence += ", the last time by " + inHundredths(doubt.metres) + " m";
  if (doubt.degrees > 0.0)
    sentence += (doubt.metres > 0.0 ? " and " : ", the last time by ") +
                inHundredths(doubt.degrees) + " deg";
  return sentence + ": nothing tells how well it is known";
}

}  // namespace grid_path_planner::localization
