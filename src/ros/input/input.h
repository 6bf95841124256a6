// An input of a node: each message that is of use by the rules, with where it was measured. All that a node subscribes to
// of what sensors say comes by this. The rules of a sonar's images:
//
//   InputRules rules;                        // what is not said here is as in input_rules.h
//   rules.oldest = 2.0;                      // s; older images, and such as are 10 s ahead, are refused
//   rules.order = InputRules::Order::RISING; // one that is not newer than the last is refused
//   rules.frames = {"map", "base_link"};     // an image waits until tf leads from its frame into these at its stamp,
//   rules.tf_wait = 0.5;                     // so long at most
//   rules.most_waiting = 5;                  // more than these are not kept meanwhile
//   rules.silent_after = 3.0;                // s; then problem() says so
//   Input<sensor_msgs::Image> images(nh, "sonar/image", rules, transforms, [&](const auto& image) {
//     draw(*image.message, image.poses[0], image.poses[1]);  // in the map, and on the vehicle
//   });
//   if (const auto why = images.problem()) hold(*why);
//
// The rules of a node's input are a row of the table in input_rules.cpp, with the reason why they are so.
//
// Guaranteed: `use` is called by the queue of `nh`, for one message after the other; a std::exception of it, but std::bad_alloc,
// refuses its message. What is refused is told in the log, the first of a reason at once, then one in 5 s, and counted.
// ROS time that goes back forgets what waits. What comes while there is no ROS time is refused. Lengths are checked and what
// waits in roscpp is bounded (bounded_subscription.h).
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/serialization.h>
#include <ros/steady_timer.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/node_time.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/input_judge.h"

namespace grid_path_planner::nodes {

// Adds what came of an input to a status of the diagnostics: NAME, which is how many came, "NAME used", ...
void addTo(diagnostic_updater::DiagnosticStatusWrapper& status, const std::string& name,
           const InputCounts& counts);

// What does not depend on the message's type.
class InputBase {
 public:
  virtual ~InputBase() { shutdown(); }
  InputBase(const InputBase&) = delete;
  InputBase& operator=(const InputBase&) = delete;

  // Why nothing of use comes, in one sentence, for whoever holds, the diagnostics and the log alike; none: all is well. What
  // stands before its ": " stays the same while it is so. Thread-safe, as all that does not say otherwise.
  std::optional<std::string> problem() const { return judge_.problem(now()); }
  InputCounts counts() const { return judge_.counts(); }
  // s of the wall clock in which nothing came at all, of use or not, from the start or beginAnew() on.
  double silence() const { return judge_.silence(now()); }
  // The stamp of the newest that was used, at most ROS time then; 0 where none was.
  ros::Time newest() const { return judge_.newest(); }
  const std::string& topic() const { return topic_; }

  // Forgets what waits. `why`, in a few words, is the reason in counts().
  void clear(const std::string& why) { judge_.clear(why); }
  // And what came before: as at the start. ROS time that goes back does so.
  void beginAnew(const std::string& why) { judge_.beginAnew(why, now()); }
  // Nothing comes any more. Asks the master, which may not answer.
  void shutdown();
  // In the thread of the queue.
  void setRules(const InputRules& rules);
  // Looks up what waits: in the thread of the queue, for whoever does not wait for the next 10 ms.
  void poll();

 protected:
  // `on_ready` is called by the queue where there is one to use. `transforms` outlives this.
  InputBase(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
            const FrameLookup& transforms, std::function<void()> on_ready);

  WaitingBound inboxOf(const InputRules& rules) const;
  std::optional<std::string> add(const ros::Time& stamp, const std::string& frame,
                                 std::size_t bytes, boost::shared_ptr<const void> message);
  std::optional<InputJudge::Item> take() { return judge_.take(); }
  // Why it was refused.
  std::optional<std::string> use(const InputJudge::Item& item, const std::function<void()>& work);

  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;

 private:
  void timeWentBack(double seconds);
  InputJudge::Moment now() const;
  Eigen::Isometry3d poseOf(const std::string& into, const std::string& frame,
                           const ros::Time& stamp) const;

  const std::string topic_;  // resolved
  const FrameLookup& transforms_;
  NodeTime& time_;
  const std::function<void()> on_ready_;
  InputJudge judge_;
  ros::SteadyTimer timer_;  // runs while something waits
  std::shared_ptr<void> jumps_;
};

template <class Message>
class Input : public InputBase {
 public:
  struct Arrival {
    boost::shared_ptr<const Message> message;
    std::vector<Eigen::Isometry3d>
        poses;  // of its frame in each of the rules' frames, at its stamp
  };
  using Use = std::function<void(const Arrival&)>;

  Input(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
        const FrameLookup& transforms, Use use)
      : InputBase(nh, topic, rules, transforms, [this] { useAll(); }), use_(std::move(use)) {
    subscribe(topic, rules);
  }
  // For another thread, which uses them by useNext(): `on_ready` is called where there is one, in the queue's.
  Input(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
        const FrameLookup& transforms, std::function<void()> on_ready)
      : InputBase(nh, topic, rules, transforms, std::move(on_ready)) {
    subscribe(topic, rules);
  }
  ~Input() override { shutdown(); }

  // The oldest that is ready. Returns whether there was one. In any thread.
  bool useNext(const Use& use) {
    const auto item = take();
    if (item) used(*item, use);
    return item.has_value();
  }
  // As if it had come by the topic, in the thread of the queue. Why it is refused, as far as that is known at once.
  std::optional<std::string> give(const boost::shared_ptr<const Message>& message) {
    const auto bytes = ros::serialization::serializationLength(*message);
    const auto* header = ros::message_traits::header(*message);
    return header ? added(header->stamp, header->frame_id, bytes, message)
                  : added(ros::Time(), "", bytes, message);
  }

 private:
  void subscribe(const std::string& topic, const InputRules& rules) {
    using Event = ros::MessageEvent<const Message>;
    subscriber_ = subscribeBounded<Message, const Event&>(
        nh_, topic, inboxOf(rules), [this](const Event& event) { give(event.getMessage()); });
  }
  std::optional<std::string> added(const ros::Time& stamp, const std::string& frame,
                                   std::size_t bytes,
                                   const boost::shared_ptr<const Message>& message) {
    last_refusal_.reset();
    if (auto why = add(stamp, frame, bytes, message)) return why;
    return last_refusal_;
  }
  std::optional<std::string> used(const InputJudge::Item& item, const Use& use) {
    const Arrival arrival{boost::static_pointer_cast<const Message>(item.message), item.poses};
    return InputBase::use(item, [&] { use(arrival); });
  }
  void useAll() {
    while (const auto item = take()) last_refusal_ = used(*item, use_);
  }

  const Use use_;
  std::optional<std::string> last_refusal_;  // of use_, since the last that was given
};

}  // namespace grid_path_planner::nodes
