#include "ros/guard/incoming/bounded_subscription.h"

#include <ros/console.h>

#include <memory>
#include <utility>

#include "base/current_error.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kRefusalPeriod = 1.0;  // s

// What a message costs besides its bytes.
constexpr std::size_t kOverhead = 256;

std::size_t costOf(const SerializedArrival& arrival) {
  return arrival.bytes.size() + kOverhead;
}

// What waits, and who is called for it: apart from the subscription, since a callback may run while that ends.
class Waiting {
 public:
  Waiting(std::string topic, ros::SubscriptionCallbackHelperPtr helper, const WaitingBound& bound)
      : topic_(std::move(topic)), helper_(std::move(helper)), inbox_(bound) {}

  bool add(SerializedArrival arrival) { return inbox_.add(std::move(arrival)); }

  // In a thread of the queue. False where another one is at it: messages are handled one after the other, in their order.
  bool callForOldest() {
    const std::unique_lock<std::recursive_mutex> lock(calling_, std::try_to_lock);
    if (!lock) return false;
    if (std::optional<SerializedArrival> arrival = inbox_.take()) call(std::move(*arrival));
    return true;
  }

 private:
  void call(SerializedArrival arrival) {
    const ros::VoidConstPtr message = unpacked(arrival);
    if (!message) return;
    arrival.bytes = {};  // what the callback takes, it takes without them
    using Event = ros::MessageEvent<const void>;
    ros::SubscriptionCallbackHelperCallParams given;
    given.event = Event(message, arrival.header, arrival.received, false, Event::CreateFunction());
    helper_->call(given);
  }

  // Null where it is refused.
  ros::VoidConstPtr unpacked(SerializedArrival& arrival) {
    ros::SubscriptionCallbackHelperDeserializeParams given;
    std::uint8_t none = 0;
    given.buffer = arrival.bytes.empty() ? &none : arrival.bytes.data();
    given.length = static_cast<std::uint32_t>(arrival.bytes.size());
    given.connection_header = arrival.header;
    try {
      return helper_->deserialize(given);
    } catch (...) {
      const ros::SteadyTime now = ros::SteadyTime::now();
      if (!told_.isZero() && (now - told_).toSec() < kRefusalPeriod) return {};
      told_ = now;
      ROS_ERROR_STREAM("A message of " << arrival.bytes.size() << " bytes on " << topic_
                                       << " is dropped: " << base::currentErrorText());
      return {};
    }
  }

  const std::string topic_;
  const ros::SubscriptionCallbackHelperPtr helper_;
  Inbox inbox_;
  std::recursive_mutex calling_;  // a callback may serve the queue
  ros::SteadyTime told_;
};

class Turn : public ros::CallbackInterface {
 public:
  explicit Turn(std::shared_ptr<Waiting> waiting) : waiting_(std::move(waiting)) {}
  CallResult call() override { return waiting_->callForOldest() ? Success : TryAgain; }

 private:
  const std::shared_ptr<Waiting> waiting_;
};

// In the place of that helper: keeps the bytes of each message as it arrives, in the thread that received it. That
// its type is no message's makes publishers in this process serialize too.
class Arrivals : public ros::SubscriptionCallbackHelper {
 public:
  Arrivals(std::shared_ptr<Waiting> waiting, ros::CallbackQueueInterface& queue)
      : waiting_(std::move(waiting)), queue_(queue) {}

  ros::CallbackQueueInterface& atOnce() { return at_once_; }

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& given) override {
    auto arrival = boost::make_shared<SerializedArrival>();
    arrival->bytes.assign(given.buffer, given.buffer + given.length);
    return arrival;
  }
  void call(ros::SubscriptionCallbackHelperCallParams& given) override {
    const auto arrival = boost::static_pointer_cast<const SerializedArrival>(
        boost::shared_ptr<const void>(given.event.getMessage()));
    // Another subscriber of this process is given the same one.
    SerializedArrival taken = given.event.nonConstWillCopy()
                                  ? *arrival
                                  : std::move(const_cast<SerializedArrival&>(*arrival));
    taken.header = given.event.getConnectionHeaderPtr();
    taken.received = given.event.getReceiptTime();
    if (waiting_->add(std::move(taken)))
      queue_.addCallback(boost::make_shared<Turn>(waiting_), owner());
  }
  const std::type_info& getTypeInfo() override { return typeid(SerializedArrival); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  // The queue that roscpp knows for the subscription, and from which it removes what waits when that ends.
  class AtOnce : public ros::CallbackQueueInterface {
   public:
    explicit AtOnce(Arrivals& arrivals) : arrivals_(arrivals) {}
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
      callback->call();
    }
    void removeByID(std::uint64_t) override { arrivals_.queue_.removeByID(arrivals_.owner()); }

   private:
    Arrivals& arrivals_;
  };

  std::uint64_t owner() const { return reinterpret_cast<std::uint64_t>(this); }

  const std::shared_ptr<Waiting> waiting_;
  ros::CallbackQueueInterface& queue_;
  AtOnce at_once_{*this};
};

}  // namespace

bool Inbox::add(SerializedArrival arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t before = waiting_.size();
  bytes_ += costOf(arrival);
  waiting_.push_back(std::move(arrival));
  while ((bytes_ > most_.bytes || waiting_.size() > most_.messages) && waiting_.size() > 1) {
    bytes_ -= costOf(waiting_.front());
    waiting_.pop_front();
  }
  return waiting_.size() > before;
}

std::optional<SerializedArrival> Inbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  std::optional<SerializedArrival> oldest = std::move(waiting_.front());
  bytes_ -= costOf(*oldest);
  waiting_.pop_front();
  return oldest;
}

std::size_t Inbox::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

ros::Subscriber subscribeBounded(ros::NodeHandle nh, ros::SubscribeOptions options,
                                 const WaitingBound& bound) {
  const auto waiting =
      std::make_shared<Waiting>(nh.resolveName(options.topic), options.helper, bound);
  const auto arrivals = boost::make_shared<Arrivals>(waiting, *nh.getCallbackQueue());
  options.helper = arrivals;
  options.queue_size = 1;  // each is taken when it arrives
  options.callback_queue = &arrivals->atOnce();
  options.transport_hints.tcpNoDelay();  // as in claimed_lengths.h
  return nh.subscribe(options);
}

}  // namespace grid_path_planner::nodes
