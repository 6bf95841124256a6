// The rules of every input of the nodes, against their words: each row of the table with each kind of stamp, frame, age, order
// and silence; then messages in any order, of which only laws are asked.
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include "ros/input/input_judge.h"

namespace grid_path_planner::nodes {
namespace {

using Moment = InputJudge::Moment;
using Order = InputRules::Order;
using Strings = std::set<std::string>;

constexpr double kTestTime = 5000.0;  // s

Moment momentAt(double time, double wall) {
  return {ros::Time(time), std::chrono::steady_clock::time_point(
                               std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                   std::chrono::duration<double>(1000.0 + wall)))};
}

enum class Tf { KNOWN, LATE, NEVER };

// The pose of a sensor as its stamp has it, so that another one's shows.
Eigen::Isometry3d poseAt(const std::string& into, double stamp) {
  return Eigen::Isometry3d(Eigen::Translation3d(stamp, static_cast<double>(into.size()), 0.0));
}

InputJudge::Place tfThat(bool knows) {
  return [knows](const std::string& into, const std::string&, const ros::Time& stamp) {
    if (!knows) throw std::runtime_error("nothing on /tf names it");
    return poseAt(into, stamp.toSec());
  };
}

// ---- Each row, each combination

struct Case {
  bool has_stamp, has_frame;
  double age;  // s, when it comes; below 0: ahead
  Tf tf;
  std::optional<double>
      before;    // s after the stamp: that of one that came before; none: it is the first
  double later;  // s, until it is looked at again
  bool by_clock_topic;
};

struct Fate {
  bool used = false, waits = false;
  Strings reasons;  // one of these, where it is refused
};

// What the words of the rules say of a case, whose one before has the stamp `last`, 0: none.
class Reference {
 public:
  Reference(const InputRules& rules, const Case& c) : rules_(rules), case_(c) {
    stamp_ = c.has_stamp ? kTestTime - c.age : kTestTime;
    if (!c.before || (!c.has_frame && rules.frame_required)) return;
    const double before = stamp_ + *c.before, came = std::min(before, kTestTime);
    const bool is_early = rules.order == Order::RISING && before > kTestTime;
    if (before - came > rules.most_ahead || is_early) return;
    before_used_ = came;
    if (rules.order != Order::ANY) last_ = came;
  }

  // Whether, and as of when, one before it was used.
  std::optional<double> beforeUsed() const { return before_used_; }

  Fate atFirst() const {
    Fate fate{false, false, refusals()};
    if (!fate.reasons.empty()) return fate;
    fate.waits = isTooEarly(kTestTime) || (asksTf() && case_.tf != Tf::KNOWN);
    fate.used = !fate.waits;
    return fate;
  }
  Fate later() const {
    Fate fate = atFirst();
    if (!fate.waits) return fate;
    const bool placed = !asksTf() || case_.tf != Tf::NEVER;
    if (!isTooEarly(kTestTime + case_.later) && placed) return {true, false, {}};
    if (case_.later <= rules_.tf_wait) return fate;
    return {
        false, false, {isTooEarly(kTestTime + case_.later) ? "ahead of ROS time" : "no transform"}};
  }
  // Whether it is silent at `time`, where the last use was of a stamp, and came, then.
  bool isSilent(double time, std::optional<double> used_stamp, double used_at) const {
    if (!used_stamp) return true;
    const bool by_stamp = rules_.silence == InputRules::Silence::BY_STAMP;
    return time - (by_stamp ? *used_stamp : used_at) > rules_.silent_after;
  }

 private:
  bool asksTf() const { return !rules_.frames.empty(); }
  bool isTooEarly(double time) const {
    return (rules_.order == Order::RISING && stamp_ > time) ||
           (case_.by_clock_topic && stamp_ - time > rules_.most_ahead);
  }
  Strings refusals() const {
    Strings reasons;
    const bool is_now = !case_.has_stamp;
    if (is_now && rules_.stamp == InputRules::Stamp::REQUIRED) reasons.insert("no stamp");
    if (!case_.has_frame && rules_.frame_required) reasons.insert("no frame");
    if (!is_now && case_.age > rules_.oldest) reasons.insert("too old");
    const double most_ahead =
        case_.by_clock_topic ? std::max(rules_.most_ahead, 10.0) : rules_.most_ahead;
    if (!is_now && -case_.age > most_ahead) reasons.insert("ahead of ROS time");
    if (last_ && stamp_ <= *last_) reasons.insert("not newer than the one before");
    return reasons;
  }

  const InputRules& rules_;
  const Case case_;
  double stamp_ = 0.0;
  std::optional<double> before_used_, last_;
};

class RowTest {
 public:
  RowTest(const InputRow& row, const Case& c)
      : row_(row), case_(c), reference_(row.rules, c), judge_("/topic", row.rules, at(1.0, -3.0)) {}

  void run() {
    letBeforeCome();
    const ros::Time stamp(case_.has_stamp ? kTestTime - case_.age : 0.0);
    judge_.add({stamp, case_.has_frame ? "sensor" : "", 100}, nullptr, now_);
    expect(reference_.atFirst(), case_.tf == Tf::KNOWN);
    now_ = at(kTestTime + case_.later, case_.later);
    expectProblem(kTestTime + case_.later);
    expect(reference_.later(), case_.tf != Tf::NEVER);
  }

 private:
  Moment at(double time, double wall) const {
    Moment moment = momentAt(time, wall);
    moment.by_clock_topic = case_.by_clock_topic;
    return moment;
  }
  // Of the same frame, as another one has an order of its own.
  void letBeforeCome() {
    if (case_.before) {
      const double stamp = (case_.has_stamp ? kTestTime - case_.age : kTestTime) + *case_.before;
      now_ = at(std::min(stamp, kTestTime), std::min(*case_.before, 0.0));
      judge_.add({ros::Time(stamp), case_.has_frame ? "sensor" : "", 100}, nullptr, now_);
      judge_.place(tfThat(true), now_);
      useAll();
      if (!reference_.beforeUsed() || judge_.waits()) judge_.beginAnew("test", now_);
      used_before_ = judge_.counts().used;
    }
    refused_before_ = judge_.counts().refused;
    now_ = at(kTestTime, 0.0);
  }
  void useAll() {
    while (const auto item = judge_.take()) {
      ASSERT_EQ(item->poses.size(), row_.rules.frames.size());
      for (std::size_t i = 0; i < item->poses.size(); ++i)
        EXPECT_TRUE(
            item->poses[i].isApprox(poseAt(row_.rules.frames[i], item->header.stamp.toSec())));
      judge_.countUsed(*item, now_);
    }
  }
  void expect(const Fate& fate, bool tf_knows) {
    judge_.place(tfThat(tf_knows), now_);
    useAll();
    const InputCounts counts = judge_.counts();
    EXPECT_EQ(counts.used - used_before_, fate.used ? 1U : 0U);
    EXPECT_EQ(counts.waiting, fate.waits ? 1U : 0U);
    EXPECT_EQ(counts.received, counts.used + counts.waiting + counts.refusedInAll());
    std::string reason;
    for (const auto& [name, count] : counts.refused)
      if (const auto known = refused_before_.find(name);
          known == refused_before_.end() || known->second != count)
        reason = name == "overtaken by a newer one" ? "not newer than the one before" : name;
    EXPECT_EQ(reason.empty(), fate.used || fate.waits) << reason;
    EXPECT_TRUE(reason.empty() || fate.reasons.count(reason) == 1) << reason;
  }
  // After it was looked at first, before it is again.
  void expectProblem(double time) {
    const Fate fate = reference_.atFirst();
    std::optional<double> used = reference_.beforeUsed();
    double used_at = used ? kTestTime + std::min(*case_.before, 0.0) : 0.0;
    if (fate.used) {
      used = std::max(used.value_or(0.0), std::min(stampOfCase(), kTestTime));
      used_at = kTestTime;
    }
    const auto problem = judge_.problem(now_);
    if (std::isinf(row_.rules.silent_after)) {
      EXPECT_EQ(problem.has_value(), !fate.used) << problem.value_or("");
    } else {
      EXPECT_EQ(problem.has_value(), reference_.isSilent(time, used, used_at))
          << problem.value_or("");
    }
    if (problem) {
      EXPECT_NE(problem->find("/topic"), std::string::npos);
      const bool tells_why = problem->find(": ") != std::string::npos;
      EXPECT_EQ(tells_why, !fate.used) << *problem;
    }
  }
  double stampOfCase() const { return case_.has_stamp ? kTestTime - case_.age : kTestTime; }

  const InputRow& row_;
  const Case case_;
  const Reference reference_;
  InputJudge judge_;
  Moment now_ = momentAt(1.0, -3.0);
  std::uint64_t used_before_ = 0;
  std::map<std::string, std::uint64_t> refused_before_;
};

// About each limit of the row, and far beyond.
std::vector<double> agesOf(const InputRules& rules) {
  std::vector<double> ages = {0.0, 0.05, -0.05, 4000.0, -4000.0, kTestTime - 1.0};
  for (const double limit : {rules.oldest, -rules.most_ahead, -10.0})
    if (!std::isinf(limit))
      for (const double beside : {-0.02, 0.02}) ages.push_back(limit + beside);
  return ages;
}

std::vector<double> latersOf(const InputRules& rules) {
  std::vector<double> laters = {0.0, 0.9 * rules.tf_wait, 1.1 * rules.tf_wait, 1000.0};
  if (!std::isinf(rules.silent_after))
    for (const double part : {0.9, 1.1}) laters.push_back(part * rules.silent_after);
  return laters;
}

TEST(InputLaws, EachRowDoesWhatItsWordsSay) {
  std::size_t cases = 0;
  const std::vector<std::optional<double>> befores = {std::nullopt, -0.03, 0.0, 0.03};
  for (const InputRow& row : inputTable())
    for (const bool has_stamp : {true, false})
      for (const bool has_frame : {true, false})
        for (const double age : has_stamp ? agesOf(row.rules) : std::vector<double>{0.0})
          for (const Tf tf : {Tf::KNOWN, Tf::LATE, Tf::NEVER})
            for (const auto& before : befores)
              for (const double later : latersOf(row.rules))
                for (const bool by_clock_topic : {false, true}) {
                  const Case c{has_stamp, has_frame, age, tf, before, later, by_clock_topic};
                  SCOPED_TRACE(row.node + " " + row.topic + " stamp " + std::to_string(has_stamp) +
                               " frame " + std::to_string(has_frame) + " age " +
                               std::to_string(age) + " tf " + std::to_string(static_cast<int>(tf)) +
                               " before " + (before ? std::to_string(*before) : "none") +
                               " later " + std::to_string(later) + " by /clock " +
                               std::to_string(by_clock_topic));
                  RowTest(row, c).run();
                  ++cases;
                  if (HasFailure()) return;
                }
  std::cout << cases << " cases of " << inputTable().size() << " inputs\n";
  EXPECT_GT(cases, 20000U);
}

// As fast as a bag is played, /clock is behind what the sensors of the bag say: each was refused, or waited for in the node's
// only thread.
TEST(InputLaws, WhatOvertookTheClockIsUsedInTheOrderOfItsComing) {
  const InputRules& rules = rulesOf("vehicle_localizer", "imu/data");
  Moment now = momentAt(100.0, 0.0);
  now.by_clock_topic = true;
  InputJudge judge("/imu", rules, now);
  for (const double stamp : {100.05, 100.3, 100.2, 100.08})
    EXPECT_FALSE(judge.add({ros::Time(stamp), "imu", 1}, nullptr, now)) << stamp;
  std::vector<double> used;
  const auto use_at = [&](double time) {
    now.time = ros::Time(time);
    judge.place(tfThat(true), now);
    while (const auto item = judge.take()) {
      used.push_back(item->header.stamp.toSec());
      judge.countUsed(*item, now);
    }
  };
  use_at(100.0);
  EXPECT_EQ(used, (std::vector<double>{100.05, 100.08}));
  use_at(100.25);
  EXPECT_EQ(used, (std::vector<double>{100.05, 100.08, 100.3, 100.2}));
  EXPECT_TRUE(judge.add({ros::Time(120.0), "imu", 1}, nullptr, now)) << "of another clock";
}

// ---- In any order

class Sequence {
 public:
  Sequence(const InputRules& rules, unsigned seed)
      : rules_(rules), random_(seed), judge_("/topic", rules, now()) {}

  void run(int steps) {
    for (int i = 0; i < steps && !testing::Test::HasFailure(); ++i) {
      step();
      check();
    }
    cease();
  }
  std::uint64_t received() const { return judge_.counts().received; }

 private:
  Moment now() const { return momentAt(time_, wall_); }
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  std::size_t one(std::size_t of) { return random_() % of; }

  void step() {
    const double passed = any(0.0, 0.2);
    wall_ += passed;
    if (one(10) > 0) time_ += one(50) == 0 ? 20.0 : passed;
    switch (one(8)) {
      case 0:
        return place();
      case 1:
        return take();
      case 2:
        return one(20) == 0 ? clear() : take();
      default:
        return add();
    }
  }
  void add() {
    const char* const frames[] = {"a", "a", "a", "b", "late", "never", ""};
    const double ages[] = {0.0, 0.0, 0.1, any(0.0, 12.0), -any(0.0, 12.0), 1e6, -1e6};
    double stamp = time_ - ages[one(std::size(ages))];
    if (one(10) == 0 && !stamps_.empty())
      stamp = *std::next(stamps_.begin(), static_cast<std::ptrdiff_t>(one(stamps_.size())));
    const ros::Time time(one(20) == 0 ? 0.0 : std::max(1.0, stamp));
    const std::size_t bytes = one(30) == 0 ? rules_.most_bytes / 2 : 1000;
    const auto id = boost::make_shared<int>(next_++);
    const auto why = judge_.add({time, frames[one(std::size(frames))], bytes}, id, now());
    EXPECT_TRUE(!why || !why->empty());
    if (!why) alive_.insert(*id);
    stamps_.insert(stamp);
  }
  void place() {
    judge_.place(
        [this](const std::string& into, const std::string& frame, const ros::Time& stamp) {
          if (frame == "never" || (frame == "late" && stamp.toSec() > time_ - 0.4))
            throw std::runtime_error("not yet");
          return poseAt(into, stamp.toSec());
        },
        now());
  }
  void take() {
    const auto item = judge_.take();
    if (!item) return;
    const int id = *boost::static_pointer_cast<const int>(item->message);
    EXPECT_EQ(alive_.erase(id), 1U) << "taken twice, or after it was refused";
    EXPECT_EQ(item->poses.size(), rules_.frames.size());
    if (!rules_.frames.empty()) {
      EXPECT_NE(item->header.frame, "never");
    }
    if (rules_.order == Order::RISING) {
      ros::Time& last = last_[item->header.frame];
      EXPECT_GT(item->header.stamp, last);
      EXPECT_LE(item->header.stamp, now().time);
      last = item->header.stamp;
    }
    if (one(5) == 0)
      judge_.countRefused("it is blank", now());
    else
      judge_.countUsed(*item, now());
  }
  void clear() {
    const bool anew = one(2) == 0;
    anew ? judge_.beginAnew("asked for", now()) : judge_.clear("asked for");
    alive_.clear();
    last_.clear();
    EXPECT_EQ(judge_.counts().waiting, 0U);
    if (anew) {
      EXPECT_EQ(judge_.problem(now()).has_value(), !std::isinf(rules_.silent_after));
      EXPECT_EQ(judge_.silence(now()), 0.0);
    }
  }
  void check() {
    const InputCounts counts = judge_.counts();
    EXPECT_EQ(counts.received, counts.used + counts.waiting + counts.refusedInAll());
    EXPECT_LE(counts.waiting, 2 * rules_.most_waiting);
    EXPECT_LE(counts.waiting, alive_.size());
  }
  // Nothing comes any more: what waits is used, or refused once it has waited for tf_wait.
  void cease() {
    wall_ += rules_.tf_wait + 0.01;
    place();
    EXPECT_FALSE(judge_.waits());
    while (judge_.counts().waiting > 0 && !testing::Test::HasFailure()) take();
    check();
  }

  const InputRules rules_;
  std::mt19937 random_;
  double time_ = kTestTime, wall_ = 0.0;
  int next_ = 0;
  std::set<int> alive_;
  std::set<double> stamps_;
  std::map<std::string, ros::Time> last_;
  InputJudge judge_;
};

TEST(InputLaws, EachMessageIsUsedOnceOrRefusedOrWaits) {
  std::uint64_t messages = 0;
  for (const InputRow& row : inputTable())
    for (unsigned seed = 1; seed <= 40; ++seed) {
      SCOPED_TRACE(row.node + " " + row.topic + " seed " + std::to_string(seed));
      Sequence sequence(row.rules, seed);
      sequence.run(150);
      messages += sequence.received();
      if (HasFailure()) return;
    }
  std::cout << messages << " messages\n";
}

// ---- What the table does not say

class CrowdTest : public testing::Test {
 protected:
  InputRules rules(Order order, std::size_t most) {
    InputRules rules;
    rules.order = order;
    rules.most_waiting = most;
    rules.frames = {"map"};
    return rules;
  }
  void add(InputJudge& judge, double stamp, const std::string& frame, std::size_t bytes = 1) {
    judge.add({ros::Time(stamp), frame, bytes}, nullptr, momentAt(kTestTime, 0.0));
  }
  std::vector<double> taken(InputJudge& judge) {
    std::vector<double> stamps;
    judge.place(tfThat(true), momentAt(kTestTime, 0.0));
    while (const auto item = judge.take()) stamps.push_back(item->header.stamp.toSec());
    return stamps;
  }
};

// Where tf came later than queue_size clouds, the oldest always went, and none was ever mapped.
TEST_F(CrowdTest, TheOldestIsKeptWhichTfReachesFirst) {
  for (const Order order : {Order::ANY, Order::RISING, Order::NEWEST}) {
    InputJudge judge("/topic", rules(order, 3), momentAt(1.0, 0.0));
    for (int i = 0; i < 10; ++i) add(judge, kTestTime - 5.0 + 0.1 * i, "sensor");
    judge.place(
        [](auto&, auto&, const ros::Time& stamp) {
          if (stamp.toSec() > kTestTime - 4.95) throw std::runtime_error("not yet");
          return Eigen::Isometry3d::Identity();
        },
        momentAt(kTestTime, 0.0));
    const auto first = judge.take();
    ASSERT_TRUE(first);
    EXPECT_NEAR(first->header.stamp.toSec(), kTestTime - 5.0, 1e-6);
    const std::vector<double> stamps = taken(judge);
    ASSERT_EQ(stamps.size(), order == Order::NEWEST ? 1U : 2U);
    EXPECT_NEAR(stamps.back(), kTestTime - 4.1, 1e-6);
  }
}

TEST_F(CrowdTest, NoFrameCrowdsOutAnother) {
  InputJudge judge("/topic", rules(Order::ANY, 4), momentAt(1.0, 0.0));
  add(judge, kTestTime - 1.0, "quiet");
  for (int i = 0; i < 100; ++i) add(judge, kTestTime, "loud");
  add(judge, kTestTime - 0.5, "quiet");
  judge.place(
      [](auto&, const std::string& frame, auto&) {
        if (frame == "loud") throw std::runtime_error("not known");
        return Eigen::Isometry3d::Identity();
      },
      momentAt(kTestTime, 0.0));
  EXPECT_TRUE(judge.take() && judge.take());
}

TEST_F(CrowdTest, WhatWaitsIsBoundedInBytesButForOne) {
  InputJudge judge("/topic", rules(Order::ANY, 100), momentAt(1.0, 0.0));
  const std::size_t most = InputRules().most_bytes;
  for (int i = 0; i < 10; ++i) add(judge, kTestTime, "sensor", most / 4);
  EXPECT_EQ(judge.counts().waiting, 4U);
  EXPECT_EQ(judge.counts().refused.at("too many bytes waiting"), 6U);
  add(judge, kTestTime, "sensor", 2 * most);
  EXPECT_EQ(judge.counts().waiting, 1U);
}

TEST_F(CrowdTest, OfThoseThatMayBeUsedTheNewestAreKept) {
  InputJudge judge("/topic", rules(Order::RISING, 2), momentAt(1.0, 0.0));
  for (const double age : {0.5, 0.4, 0.3, 0.2}) {
    add(judge, kTestTime - age, "sensor");
    judge.place(tfThat(true), momentAt(kTestTime, 0.0));
  }
  const std::vector<double> stamps = taken(judge);
  ASSERT_EQ(stamps.size(), 2U);
  EXPECT_NEAR(stamps.front(), kTestTime - 0.3, 1e-6);
  EXPECT_EQ(judge.counts().refused.at("faster than they are used"), 2U);
}

// Whoever asks seldom is given none that is old already, and is not told that it is slow.
TEST_F(CrowdTest, OfAFrameWhoseNewestIsAskedForNoOlderOneIsUsed) {
  InputJudge judge("/topic", rules(Order::NEWEST, 2), momentAt(1.0, 0.0));
  for (const double age : {0.5, 0.4, 0.3}) {
    add(judge, kTestTime - age, "front");
    add(judge, kTestTime - age - 0.01, "rear");
    judge.place(tfThat(true), momentAt(kTestTime, 0.0));
  }
  const std::vector<double> stamps = taken(judge);
  ASSERT_EQ(stamps.size(), 2U) << "of each frame";
  for (const double stamp : stamps) EXPECT_NEAR(stamp, kTestTime - 0.305, 0.006);
  EXPECT_EQ(judge.counts().refused.at("overtaken by a newer one"), 4U);
  EXPECT_EQ(judge.counts().last_refusal, "");
}

// Two lasers on one topic, at the same time: one of them was never used.
TEST_F(CrowdTest, EachFrameHasItsOwnOrder) {
  InputJudge judge("/topic", rules(Order::RISING, 5), momentAt(1.0, 0.0));
  add(judge, kTestTime - 0.1, "front");
  add(judge, kTestTime - 0.1, "rear");
  EXPECT_EQ(taken(judge).size(), 2U);
  add(judge, kTestTime - 0.1, "rear");
  EXPECT_EQ(taken(judge).size(), 0U);
}

// A driver with a clock of its own: the difference is in the sentence.
TEST_F(CrowdTest, AnotherClockIsToldWithItsDifference) {
  InputRules rules;
  rules.silent_after = 1.0;
  std::vector<std::string> told;
  InputJudge judge("/topic", rules, momentAt(1.0, 0.0),
                   [&](const std::string& sentence) { told.push_back(sentence); });
  for (int i = 0; i < 10; ++i) add(judge, kTestTime - 3600.0, "laser");
  ASSERT_EQ(told.size(), 1U) << "once in 5 s";
  const std::string why =
      "it is 3600.0 s old, more than 10 s: its clock is another one than ROS time; a bag that is "
      "played needs use_sim_time";
  EXPECT_EQ(told[0], "A message on /topic in frame 'laser' stamped 1400.000 is refused: " + why +
                         " (1 for this reason so far)");
  EXPECT_EQ(judge.problem(momentAt(kTestTime, 0.0)),
            "nothing that can be used has come on /topic yet: " + why);
  EXPECT_EQ(judge.counts().last_refusal, why);
  add(judge, kTestTime + 1e8, "laser");
  EXPECT_NE(told.at(1).find("100000000.0 s ahead"), std::string::npos) << told[1];
}

TEST_F(CrowdTest, ARefusalIsNoReasonForASilenceAfterwards) {
  InputRules rules;
  rules.silent_after = 1.0;
  InputJudge judge("/topic", rules, momentAt(1.0, 0.0));
  add(judge, kTestTime - 3600.0, "laser");
  add(judge, kTestTime, "laser");
  judge.countUsed(judge.take().value(), momentAt(kTestTime, 0.0));
  EXPECT_EQ(judge.problem(momentAt(kTestTime, 0.9)), std::nullopt);
  EXPECT_EQ(judge.problem(momentAt(kTestTime, 1.1)), "/topic has been silent for longer than 1 s");
  add(judge, kTestTime - 3600.0, "laser");
  EXPECT_EQ(
      judge.problem(momentAt(kTestTime, 1.1))->find("nothing that can be used has come on /topic"),
      0U);
}

TEST_F(CrowdTest, WhatAnErrorEndedIsCounted) {
  InputJudge judge("/topic", {}, momentAt(1.0, 0.0));
  add(judge, kTestTime, "sensor");
  ASSERT_TRUE(judge.take());
  EXPECT_EQ(judge.counts().waiting, 1U);
  judge.giveUp();
  EXPECT_EQ(judge.counts().waiting, 0U);
  EXPECT_EQ(judge.counts().refusedInAll(), 1U);
}

TEST(InputTable, EachRowHasAReasonAndOneName) {
  std::set<std::pair<std::string, std::string>> names;
  for (const InputRow& row : inputTable()) {
    EXPECT_TRUE(names.emplace(row.node, row.topic).second) << row.topic;
    EXPECT_FALSE(row.reason.empty()) << row.topic;
    EXPECT_EQ(&rulesOf(row.node, row.topic), &row.rules);
  }
  EXPECT_THROW(rulesOf("path_planner", "scan"), std::logic_error);
}

}  // namespace
}  // namespace grid_path_planner::nodes
