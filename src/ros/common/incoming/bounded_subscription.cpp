#include "ros/common/incoming/bounded_subscription.h"

#include <utility>

#include "ros/common/guarded_queue.h"

namespace grid_path_planner::nodes {
namespace {

// Keeps the bytes of each message. That its type is no message's makes publishers in this process
// serialize too.
class Arrivals : public ros::SubscriptionCallbackHelper {
 public:
  explicit Arrivals(std::function<void(SerializedArrival)> on_arrival)
      : on_arrival_(std::move(on_arrival)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& given) override {
    auto arrival = boost::make_shared<SerializedArrival>();
    arrival->bytes.assign(given.buffer, given.buffer + given.length);
    return arrival;
  }
  void call(ros::SubscriptionCallbackHelperCallParams& given) override {
    const auto arrival = boost::static_pointer_cast<const SerializedArrival>(
        boost::shared_ptr<const void>(given.event.getMessage()));
    SerializedArrival taken = std::move(const_cast<SerializedArrival&>(*arrival));
    taken.header = given.event.getConnectionHeaderPtr();
    taken.received = given.event.getReceiptTime();
    on_arrival_(std::move(taken));
  }
  const std::type_info& getTypeInfo() override { return typeid(SerializedArrival); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  const std::function<void(SerializedArrival)> on_arrival_;
};

// What a message costs besides its bytes.
constexpr std::size_t kOverhead = 256;

std::size_t costOf(const SerializedArrival& arrival) {
  return arrival.bytes.size() + kOverhead;
}

}  // namespace

bool Inbox::add(SerializedArrival arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t before = waiting_.size();
  bytes_ += costOf(arrival);
  waiting_.push_back(std::move(arrival));
  while (bytes_ > most_bytes_ && waiting_.size() > 1) {
    bytes_ -= costOf(waiting_.front());
    waiting_.pop_front();
  }
  return waiting_.size() > before;
}

SerializedArrival Inbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_.empty()) return {};
  SerializedArrival oldest = std::move(waiting_.front());
  bytes_ -= costOf(oldest);
  waiting_.pop_front();
  return oldest;
}

std::size_t Inbox::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

ArrivalSubscription::ArrivalSubscription(ros::NodeHandle nh, ros::SubscribeOptions options,
                                         std::size_t most_bytes,
                                         std::function<void(SerializedArrival)> on_arrival)
    : inbox_(std::make_shared<Inbox>(most_bytes)),
      on_arrival_(std::move(on_arrival)),
      queue_(*nh.getCallbackQueue()) {
  options.helper = boost::make_shared<Arrivals>([this](SerializedArrival arrival) {
    if (inbox_->add(std::move(arrival))) announce();
  });
  options.callback_queue = &at_once_;
  options.transport_hints.tcpNoDelay();  // as in claimed_lengths.h
  subscriber_ = nh.subscribe(options);
}

void ArrivalSubscription::announce() {
  queue_.addCallback(callbackOf([this] {
                       SerializedArrival arrival = inbox_->take();
                       if (!arrival.bytes.empty()) on_arrival_(std::move(arrival));
                     }),
                     owner());
}

void ArrivalSubscription::shutdown() {
  subscriber_.shutdown();
  queue_.removeByID(owner());
}

}  // namespace grid_path_planner::nodes
