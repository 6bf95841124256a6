// Which messages of an input are of use, by its rules: what Input does, without ROS connections and clocks.
//
//   InputJudge judge("/scan", rules, now);
//   if (const auto why = judge.add({stamp, frame, bytes}, message, now)) tell(*why);   // refused
//   judge.place(place, now);                                                           // often, while waits()
//   while (const auto item = judge.take()) { use(*item); judge.countUsed(*item, now); }
//
// Guaranteed: a message is used, refused with its reason, or waits; of each counts() has the number. At most most_waiting
// wait for tf and as many to be taken, with at most most_bytes, or one. Of too many that wait for tf, one of the frame goes
// that has the most, and not the oldest: it is the next that tf reaches, and where tf is late always the oldest went, none
// would ever be used. Of those to be taken the oldest goes. With /clock, ROS time comes by a topic of its own, and messages
// overtake it, the farther the faster a bag is played: there one that is ahead by more than most_ahead waits, up to tf_wait.
// Thread-safe.
#pragma once

#include <ros/time.h>

#include <Eigen/Geometry>
#include <boost/shared_ptr.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros/input/input_rules.h"

namespace grid_path_planner::nodes {

struct InputCounts {
  std::uint64_t received = 0;
  std::uint64_t used = 0;
  std::uint64_t waiting = 0;                     // for tf, to be taken, or taken and not used yet
  std::map<std::string, std::uint64_t> refused;  // by reason, in a few words
  std::string last_refusal;                      // a sentence

  std::uint64_t refusedInAll() const;
};

// What the rules ask of a message.
struct InputHeader {
  ros::Time stamp;
  std::string frame;  // as frameName() has it
  std::size_t bytes = 0;
};

class InputJudge {
 public:
  struct Moment {
    ros::Time time;
    std::chrono::steady_clock::time_point wall;
    bool by_clock_topic = false;  // ROS time comes by /clock, and messages overtake it
  };
  struct Item {
    InputHeader header;
    boost::shared_ptr<const void> message;
    std::vector<Eigen::Isometry3d> poses;  // of the message's frame in each of the rules' frames
  };
  // The pose of `frame` in `into` at `stamp`; throws std::exception where it is not known (yet).
  using Place = std::function<Eigen::Isometry3d(const std::string& into, const std::string& frame,
                                                const ros::Time& stamp)>;
  // Told a refusal: at once, then for the same reason at most every 5 s.
  using Tell = std::function<void(const std::string& sentence)>;

  // `name` is what sentences call it: its resolved topic.
  InputJudge(std::string name, const InputRules& rules, const Moment& start, Tell tell = {});

  void setRules(const InputRules& rules);

  // Why it is refused, in a sentence; none: it waits.
  std::optional<std::string> add(InputHeader header, boost::shared_ptr<const void> message,
                                 const Moment& now);
  // Looks up what waits. Returns whether there is one to take.
  bool place(const Place& place, const Moment& now);
  // Whether one waits for tf, or for its time.
  bool waits() const;
  std::optional<Item> take();
  // What became of one that was taken: each has one of these called.
  void countUsed(const Item& item, const Moment& now);
  void countRefused(const std::string& sentence, const Moment& now);
  void giveUp() noexcept;  // an error ended what was done with it

  // A message that came and is refused for what else is wrong with it.
  void refuse(const std::string& reason, const std::string& sentence, const Moment& now);
  // Forgets those that wait, and stamps.
  void clear(const std::string& why);
  // Forgets what was used, too: as at the start.
  void beginAnew(const std::string& why, const Moment& now);

  // Why it gives nothing now, in a sentence: silent, or refused, or without tf. None: all is well.
  std::optional<std::string> problem(const Moment& now) const;
  // s of the wall clock in which nothing came at all, used or not; from the start or beginAnew() on.
  double silence(const Moment& now) const;
  // The stamp of the newest that was used, at most ROS time then; 0 where none was.
  ros::Time newest() const;
  InputCounts counts() const;

 private:
  using Wall = std::chrono::steady_clock::time_point;
  struct Waiting {
    Item item;
    Wall since;
  };
  struct Refusal {
    std::string reason, sentence;
  };

  std::optional<Refusal> judged(const InputHeader& header, const Moment& now) const;
  std::optional<Refusal> judgedByOrder(const InputHeader& header) const;
  // Whether it waits until ROS time is nearer to its stamp.
  bool isEarly(const InputHeader& header, const Moment& now) const;
  bool rises() const { return rules_.order != InputRules::Order::ANY; }
  void wait(Item item, const Wall& since);
  // One that waits: true where it does not any more.
  bool placed(Waiting& waiting, const Place& place, const Moment& now);
  void makeReady(Item& item, const Moment& now);
  void dropTooMany(const Moment& now);
  void dropWaiting(const Refusal& why, const Moment& now);
  void dropReady(const Refusal& why, const Moment& now);
  std::size_t bytes() const;
  std::string refused(const Refusal& why, const InputHeader* header, const Moment& now);
  double quiet(const Moment& now) const;
  std::string reasonInBrackets() const;

  const std::string name_;
  const Tell tell_;
  mutable std::mutex mutex_;
  InputRules rules_;
  std::deque<Waiting> waiting_;  // for tf; in order of stamps where they rise
  std::deque<Item> ready_;
  std::map<std::string, ros::Time> newest_;  // stamp of the last that was ready, by frame
  InputCounts counts_;
  std::size_t taken_ = 0;
  std::uint64_t given_up_ = 0;
  std::map<std::string, Wall> told_;     // by reason
  std::string trouble_;                  // of what came, or waits, since the last that was used
  std::optional<ros::Time> used_stamp_;  // of the newest, at most ROS time
  Wall used_at_, heard_at_;
};

}  // namespace grid_path_planner::nodes
