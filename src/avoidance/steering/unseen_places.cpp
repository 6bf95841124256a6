#include "avoidance/steering/unseen_places.h"

#include <algorithm>
#include <cmath>

#include "avoidance/steering/vantage.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr double kLooksAt = 0.1;       // rad, of the direction to look in
constexpr double kLooked = 0.6;        // s of looking in vain
constexpr double kShortPath = 1.3;     // m of open path that the vehicle does not fly
constexpr double kSamePlace = 0.4;     // m
constexpr double kAtVantage = 0.15;    // m
constexpr double kLongestLook = 10.0;  // s
constexpr double kTrackStep = 0.3;     // m
constexpr std::size_t kLongestTrack = 16;
constexpr double kGivenUp = 30.0;  // s
constexpr std::size_t kMostPlaces = 32;

bool isAmong(const std::vector<Vector3d>& places, const Vector3d& place) {
  return std::any_of(places.begin(), places.end(),
                     [&](const Vector3d& other) { return (other - place).norm() < kSamePlace; });
}

void add(const Vector3d& place, std::vector<Vector3d>& places) {
  if (places.size() >= kMostPlaces) places.erase(places.begin());
  places.push_back(place);
}

}  // namespace

void UnseenPlaces::forget() {
  path_.clear();
  look_at_.reset();
  waits_since_.reset();
  turned_.clear();
  tried_.clear();
  closed_.clear();
}

void UnseenPlaces::remember(const Vector3d& vehicle) {
  if (!track_.empty() && (track_.back() - vehicle).norm() < kTrackStep) return;
  if (track_.size() >= kLongestTrack) track_.erase(track_.begin());
  track_.push_back(vehicle);
}

// At something that it did not turn to yet.
bool UnseenPlaces::looksAside(const Motion& motion, const Vector3d& place, const OpenSpace& space,
                              double d_safe) {
  for (const Vector3d& aside : unseenAside(space, motion.position, motion.yaw, place, d_safe)) {
    if (isAmong(turned_, aside)) continue;
    add(aside, turned_);
    path_ = {motion.position, motion.position};
    look_at_ = aside;
    return true;
  }
  return false;
}

// Until the place is seen, or the vehicle has been there and looked, or cannot come there.
bool UnseenPlaces::look(double time, const Vector3d& vehicle, const Steering& steering,
                        const OpenSpace& space) {
  const bool there = (vehicle - path_.back()).norm() < kAtVantage || steering.clear_path < 0.05;
  if (!there || std::abs(steering.look_error) > kLooksAt) waits_since_ = time;
  const bool done = space.seen(*look_at_) || time - *waits_since_ > kLooked;
  if (!done && time - began_ < kLongestLook) return false;
  path_.clear();
  look_at_.reset();
  waits_since_.reset();
  return true;
}

// Looking at what is unseen, long enough to have seen it; then the time begins anew.
bool UnseenPlaces::waitedInVain(double time, const Steering& steering) {
  const bool waits = steering.unseen && steering.clear_path < kShortPath &&
                     std::abs(steering.look_error) < kLooksAt;
  if (!waits) waits_since_.reset();
  if (waits && !waits_since_) waits_since_ = time;
  if (!waits || time - *waits_since_ < kLooked) return false;
  waits_since_ = time;
  return true;
}

bool UnseenPlaces::update(double time, const Motion& motion, const Steering& steering,
                          const OpenSpace& space, const KeptRoom& room, double d_safe) {
  const Vector3d& vehicle = motion.position;
  if (!closed_.empty() && time - closed_at_ > kGivenUp) forget();
  remember(vehicle);
  if (looks()) return look(time, vehicle, steering, space);
  if (!waitedInVain(time, steering)) return false;
  const Vector3d place = *steering.closed;
  if (!looksAside(motion, place, space, d_safe) && !isAmong(tried_, place)) {
    add(place, tried_);
    path_ = pathToVantage(space, room, vehicle, place, d_safe, track_);
    if (looks()) look_at_ = place;
  }
  if (!looks()) add(place, closed_);
  (looks() ? began_ : closed_at_) = time;
  return true;
}

}  // namespace grid_path_planner::avoidance
