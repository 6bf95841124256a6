// One input of a node: a topic, the rules by which its messages are of use, and where each was measured. Sensors are subscribed
// to by this alone.
//
//   InputRules rules = rulesOf("map_layers", "scan");  // a row of the table in input_rules.cpp, with its reason
//   rules.frames = {"map", "base_link"};
//   rules.tf_wait = options.tf_timeout;
//   Input<sensor_msgs::LaserScan> scans(nh, "scan", rules, transforms, [&](const auto& scan) {
//     draw(*scan.message, scan.poses[0], scan.poses[1]);  // of the scan's frame in "map" and in "base_link", at its stamp
//   });
//   if (const auto problem = scans.problem()) hold(*problem);
//
// Guaranteed: `use` is called by the thread of `nh`'s queue, for one message after the other, also where several threads serve
// the queue. A std::exception that `use` throws refuses the message, except std::bad_alloc. Refusals are counted and logged:
// the first of a reason at once, then one in 5 s. A message without ROS time is refused. When ROS time goes back, what waits is
// dropped. Lengths are checked, and what waits in roscpp is bounded, before a message is unpacked (bounded_subscription.h).
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

  struct OnReady {
    std::function<void()> call;
  };

  // Why no message is used now, in one sentence for holds, diagnostics and the log; none: all is well. With `silent_after`, no
  // message was used for that long, or none yet; without, the newest message was refused, or waits for tf. The text before
  // the first ": " stays the same as long as the problem does. Thread-safe, as all that does not say otherwise.
  std::optional<std::string> problem() const { return judge_.problem(now()); }
  InputCounts counts() const { return judge_.counts(); }
  // s of the wall clock since the last message came, whether it was used or refused; before the first, since the start or
  // beginAnew(). problem() counts from the last that was used instead.
  double silence() const { return judge_.silence(now()); }
  // The stamp of the newest message that was used, or the ROS time then where that was less; 0 before the first.
  ros::Time newest() const { return judge_.newest(); }
  const std::string& topic() const { return topic_; }

  // Drops what waits. `why`, in a few words, is the reason in counts().
  void clear(const std::string& why) { judge_.clear(why); }
  // The same, and forgets all that was used before, as at the start. Called where ROS time goes back.
  void beginAnew(const std::string& why) { judge_.beginAnew(why, now()); }
  // Ends the subscription. Waits for an answer of the master.
  void shutdown();
  // For messages from now on; what roscpp keeps stays bounded as at the start. In the thread of the queue.
  void setRules(const InputRules& rules);
  // Looks up transforms for what waits now, instead of within 10 ms. In the thread of the queue.
  void poll();

 protected:
  // `on_ready` is called by the queue when a message can be used. `transforms` outlives this.
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
    // poses[i]: of the message's frame in the rules' frames[i], at its stamp.
    std::vector<Eigen::Isometry3d> poses;
  };
  using Use = std::function<void(const Arrival&)>;

  Input(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
        const FrameLookup& transforms, Use use)
      : InputBase(nh, topic, rules, transforms, [this] { useAll(); }), use_(std::move(use)) {
    subscribe(topic, rules);
  }
  // For another thread that calls useNext(). `on_ready` is called by the queue when a message can be used.
  Input(const ros::NodeHandle& nh, const std::string& topic, const InputRules& rules,
        const FrameLookup& transforms, OnReady on_ready)
      : InputBase(nh, topic, rules, transforms, std::move(on_ready.call)) {
    subscribe(topic, rules);
  }
  ~Input() override { shutdown(); }

  // Uses the oldest message that can be used. Returns whether there was one. In any thread.
  bool useNext(const Use& use) {
    const auto item = take();
    if (item) used(*item, use);
    return item.has_value();
  }
  // The same as if `message` had come by the topic; in the thread of the queue. Returns why it is refused, if that is known
  // at once.
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
