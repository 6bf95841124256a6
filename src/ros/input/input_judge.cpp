#include "ros/input/input_judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

namespace {

constexpr double kBetweenLines = 5.0;   // s of the wall clock, for one reason
constexpr double kAnotherClock = 60.0;  // s, that no delay makes
constexpr std::size_t kMostFrames = 100;

constexpr char kNoTransform[] = "no transform";
constexpr char kAhead[] = "ahead of ROS time";
constexpr char kNotNewer[] = "not newer than the one before";
constexpr char kOvertaken[] = "overtaken by a newer one";
constexpr char kTooMany[] = "too many waiting for tf";
constexpr char kTooSlow[] = "faster than they are used";
constexpr char kTooLarge[] = "too many bytes waiting";

std::string secondsText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", value);
  return text;
}

std::string clocksText(double between) {
  return between < kAnotherClock
             ? ""
             : ": its clock is another one than ROS time; a bag that is played needs use_sim_time";
}

double secondsSince(const std::chrono::steady_clock::time_point& then,
                    const InputJudge::Moment& now) {
  return std::chrono::duration<double>(now.wall - then).count();
}

std::string describe(const InputHeader& header) {
  char stamp[32];
  std::snprintf(stamp, sizeof stamp, "%u.%03u", header.stamp.sec, header.stamp.nsec / 1000000);
  return (header.frame.empty() ? "" : " in frame '" + header.frame + "'") + " stamped " + stamp;
}

// In each of the frames; `problem` says of which tf does not know it.
bool findPoses(InputJudge::Item& item, const std::vector<std::string>& frames,
               const InputJudge::Place& place, std::string& problem) {
  std::vector<Eigen::Isometry3d> poses;
  for (const std::string& into : frames) {
    problem = "tf does not lead from " + item.header.frame + " to " + into + ": ";
    try {
      poses.push_back(place(into, item.header.frame, item.header.stamp));
    } catch (const std::exception& error) {  // tf2 throws many kinds for stamps at the end of time
      problem += error.what();
      return false;
    }
    problem += "the pose is not finite";
    if (!poses.back().matrix().allFinite()) return false;
  }
  item.poses = std::move(poses);
  return true;
}

}  // namespace

std::uint64_t InputCounts::refusedInAll() const {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : refused) sum += count;
  return sum;
}

InputJudge::InputJudge(std::string name, const InputRules& rules, const Moment& start, Tell tell)
    : name_(std::move(name)),
      tell_(std::move(tell)),
      rules_(rules),
      used_at_(start.wall),
      heard_at_(start.wall) {}

void InputJudge::setRules(const InputRules& rules) {
  const std::lock_guard<std::mutex> lock(mutex_);
  rules_ = rules;
}

std::optional<InputJudge::Refusal> InputJudge::judged(const InputHeader& header,
                                                      const Moment& now) const {
  if (rules_.frame_required && header.frame.empty())
    return Refusal{"no frame", "it names no frame"};
  if (header.stamp.isZero()) return Refusal{"no stamp", "it has no stamp"};
  const double ahead = secondsBetween(now.time, header.stamp);
  if (ahead > (now.by_clock_topic ? std::max(kMostAhead, rules_.most_ahead) : rules_.most_ahead))
    return Refusal{kAhead, "it is stamped " + secondsText(ahead) +
                               " ahead of ROS time, more than " +
                               base::decimalText(rules_.most_ahead) + " s" + clocksText(ahead)};
  if (-ahead > rules_.oldest)
    return Refusal{"too old", "it is " + secondsText(-ahead) + " old, more than " +
                                  base::decimalText(rules_.oldest) + " s" + clocksText(-ahead)};
  return judgedByOrder(header);
}

std::optional<InputJudge::Refusal> InputJudge::judgedByOrder(const InputHeader& header) const {
  if (!rises()) return std::nullopt;
  const auto newest = newest_.find(header.frame);
  if (newest == newest_.end() || header.stamp > newest->second) return std::nullopt;
  return Refusal{kNotNewer, "it is not newer than the one before"};
}

bool InputJudge::isEarly(const InputHeader& header, const Moment& now) const {
  const double ahead = secondsBetween(now.time, header.stamp);
  return (rules_.order == InputRules::Order::RISING && ahead > 0.0) ||
         (now.by_clock_topic && ahead > rules_.most_ahead);
}

std::optional<std::string> InputJudge::add(InputHeader header,
                                           boost::shared_ptr<const void> message,
                                           const Moment& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
  heard_at_ = now.wall;
  if (now.time.isZero()) return refused({"no ROS time", "there is no ROS time yet"}, &header, now);
  if (rules_.stamp == InputRules::Stamp::ZERO_IS_NOW && header.stamp.isZero())
    header.stamp = now.time;
  if (const auto why = judged(header, now)) return refused(*why, &header, now);
  Item item{std::move(header), std::move(message), {}};
  if (rules_.frames.empty() && waiting_.empty() && !isEarly(item.header, now))
    makeReady(item, now);
  else
    wait(std::move(item), now.wall);
  dropTooMany(now);
  return std::nullopt;
}

void InputJudge::wait(Item item, const Wall& since) {
  const auto later = !rises()
                         ? waiting_.end()
                         : std::upper_bound(waiting_.begin(), waiting_.end(), item.header.stamp,
                                            [](const ros::Time& stamp, const Waiting& other) {
                                              return stamp < other.item.header.stamp;
                                            });
  waiting_.insert(later, {std::move(item), since});
}

// A stamp that is ahead counts as now: those after it are newer all the same. Where memory fails nothing is moved.
void InputJudge::makeReady(Item& item, const Moment& now) {
  if (!rises()) return ready_.push_back(std::move(item));
  if (newest_.size() >= kMostFrames) newest_.clear();
  ros::Time& newest = newest_[item.header.frame];
  const ros::Time stamp = std::min(item.header.stamp, now.time);
  ready_.push_back(std::move(item));
  newest = stamp;
  if (rules_.order != InputRules::Order::NEWEST) return;
  const auto last = std::prev(ready_.end());
  const auto older = std::find_if(ready_.begin(), last, [&](const Item& other) {
    return other.header.frame == last->header.frame;
  });
  if (older == last) return;
  refused({kOvertaken, "a newer one can be used"}, &older->header, now);
  ready_.erase(older);
}

bool InputJudge::place(const Place& place, const Moment& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t i = 0; i < waiting_.size();) {
    if (placed(waiting_[i], place, now))
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    else if (rules_.order == InputRules::Order::RISING)
      break;
    else
      ++i;
  }
  dropTooMany(now);
  return !ready_.empty();
}

bool InputJudge::placed(Waiting& waiting, const Place& place, const Moment& now) {
  Item& item = waiting.item;
  if (auto why = judgedByOrder(item.header)) {
    if (rules_.order == InputRules::Order::NEWEST) why->reason = kOvertaken;
    refused(*why, &item.header, now);
    return true;
  }
  Refusal late{kNoTransform, ""};
  if (isEarly(item.header, now))
    late = {kAhead, "it is stamped " + secondsText(secondsBetween(now.time, item.header.stamp)) +
                        " ahead of ROS time"};
  else if (findPoses(item, rules_.frames, place, late.sentence))
    return makeReady(item, now), true;
  trouble_ = late.sentence;
  if (secondsSince(waiting.since, now) <= rules_.tf_wait) return false;
  refused(late, &item.header, now);
  return true;
}

void InputJudge::dropTooMany(const Moment& now) {
  while (waiting_.size() > rules_.most_waiting)
    dropWaiting({kTooMany, "more than " + std::to_string(rules_.most_waiting) + " wait for tf" +
                               (trouble_.empty() ? "" : ": " + trouble_)},
                now);
  while (ready_.size() > rules_.most_waiting)
    dropReady(
        {rules_.most_waiting == 1 ? kOvertaken : kTooSlow, "they come faster than they are used"},
        now);
  while (waiting_.size() + ready_.size() > 1 && bytes() > rules_.most_bytes) {
    const Refusal why{kTooLarge, "those that wait hold more than " +
                                     std::to_string(rules_.most_bytes / kMebibyte) + " MiB"};
    waiting_.empty() ? dropReady(why, now) : dropWaiting(why, now);
  }
}

// Of the frame that has the most, so that no frame crowds out another: the second.
void InputJudge::dropWaiting(const Refusal& why, const Moment& now) {
  std::map<std::string, std::size_t> numbers;
  for (const Waiting& waiting : waiting_) ++numbers[waiting.item.header.frame];
  const auto most = std::max_element(numbers.begin(), numbers.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  const auto isOfIt = [&](const Waiting& one) { return one.item.header.frame == most->first; };
  auto chosen = std::find_if(waiting_.begin(), waiting_.end(), isOfIt);
  if (most->second > 2 || (most->second == 2 && rules_.most_waiting > 1))
    chosen = std::find_if(std::next(chosen), waiting_.end(), isOfIt);
  refused(why, &chosen->item.header, now);
  waiting_.erase(chosen);
}

void InputJudge::dropReady(const Refusal& why, const Moment& now) {
  refused(why, &ready_.front().header, now);
  ready_.pop_front();
}

std::size_t InputJudge::bytes() const {
  std::size_t sum = 0;
  for (const Waiting& waiting : waiting_) sum += waiting.item.header.bytes;
  for (const Item& item : ready_) sum += item.header.bytes;
  return sum;
}

bool InputJudge::waits() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !waiting_.empty();
}

std::optional<InputJudge::Item> InputJudge::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (ready_.empty()) return std::nullopt;
  Item item = std::move(ready_.front());
  ready_.pop_front();
  ++taken_;
  return item;
}

void InputJudge::countUsed(const Item& item, const Moment& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_ > 0) --taken_;
  ++counts_.used;
  trouble_.clear();
  used_at_ = heard_at_ = now.wall;
  const ros::Time stamp = std::min(item.header.stamp, now.time);
  used_stamp_ = std::max(used_stamp_.value_or(stamp), stamp);
}

void InputJudge::countRefused(const std::string& sentence, const Moment& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_ > 0) --taken_;
  refused({"cannot be used", sentence}, nullptr, now);
}

void InputJudge::giveUp() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_ > 0) --taken_;
  ++given_up_;
}

void InputJudge::refuse(const std::string& reason, const std::string& sentence, const Moment& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
  heard_at_ = now.wall;
  refused({reason, sentence}, nullptr, now);
}

// Its sentence. That one was overtaken is no trouble: the newer one is used.
std::string InputJudge::refused(const Refusal& why, const InputHeader* header, const Moment& now) {
  const std::uint64_t count = ++counts_.refused[why.reason];
  if (why.reason == kOvertaken) return why.sentence;
  counts_.last_refusal = trouble_ = why.sentence;
  const auto last = told_.find(why.reason);
  if (last != told_.end() && secondsSince(last->second, now) < kBetweenLines) return why.sentence;
  told_[why.reason] = now.wall;
  if (tell_)
    tell_("A message on " + name_ + (header ? describe(*header) : "") + " is refused: " +
          why.sentence + " (" + std::to_string(count) + " for this reason so far)");
  return why.sentence;
}

void InputJudge::clear(const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const std::size_t waiting = waiting_.size() + ready_.size(); waiting > 0)
    counts_.refused[why] += waiting;
  waiting_.clear();
  ready_.clear();
  newest_.clear();
  trouble_.clear();
}

void InputJudge::beginAnew(const std::string& why, const Moment& now) {
  clear(why);
  const std::lock_guard<std::mutex> lock(mutex_);
  used_stamp_.reset();
  used_at_ = heard_at_ = now.wall;
}

std::string InputJudge::reasonInBrackets() const {
  return trouble_.empty() ? "" : ": " + trouble_;
}

double InputJudge::quiet(const Moment& now) const {
  return rules_.silence == InputRules::Silence::BY_STAMP ? secondsBetween(*used_stamp_, now.time)
                                                         : secondsSince(used_at_, now);
}

std::optional<std::string> InputJudge::problem(const Moment& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (std::isinf(rules_.silent_after))
    return trouble_.empty() ? std::nullopt
                            : std::make_optional("the last message on " + name_ +
                                                 " cannot be used" + reasonInBrackets());
  if (!used_stamp_)
    return (trouble_.empty() ? "nothing has come on " : "nothing that can be used has come on ") +
           name_ + " yet" + reasonInBrackets();
  if (quiet(now) <= rules_.silent_after) return std::nullopt;
  const std::string limit = base::decimalText(rules_.silent_after) + " s";
  if (!trouble_.empty())
    return "nothing that can be used has come on " + name_ + " for longer than " + limit +
           reasonInBrackets();
  return name_ + " has been silent for longer than " + limit;
}

double InputJudge::silence(const Moment& now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return secondsSince(heard_at_, now);
}

ros::Time InputJudge::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return used_stamp_.value_or(ros::Time());
}

InputCounts InputJudge::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  InputCounts counts = counts_;
  if (given_up_ > 0) counts.refused["ended by an error"] = given_up_;
  counts.waiting = waiting_.size() + ready_.size() + taken_;
  return counts;
}

}  // namespace grid_path_planner::nodes
