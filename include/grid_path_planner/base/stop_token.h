// One object that every long loop asks whether it should go on: inflation, kernels, searches,
// smoothing. It joins a caller's cancel request and a time limit on the steady clock.
//
//   StopSource source;
//   StopToken token = source.token(std::chrono::milliseconds(500));
//   source.cancel();                                  // elsewhere, in any thread
//   if (token.reason() != StopReason::NONE) return;   // in the loop
//
// Asking costs a clock read: loops ask every few thousand steps (see StopPoll).
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "grid_path_planner/base/status.h"

namespace grid_path_planner::base {

enum class StopReason { NONE, TIMEOUT, CANCELLED };

class StopToken {
 public:
  using Clock = std::chrono::steady_clock;

  // Never asks anyone to stop.
  StopToken() = default;

  // Cancellation wins over a time limit that has also run out.
  StopReason reason() const {
    if (cancelled_ && cancelled_->load(std::memory_order_relaxed)) return StopReason::CANCELLED;
    if (deadline_ && Clock::now() >= *deadline_) return StopReason::TIMEOUT;
    return StopReason::NONE;
  }

 private:
  friend class StopSource;
  std::shared_ptr<const std::atomic<bool>> cancelled_;
  std::optional<Clock::time_point> deadline_;
};

class StopSource {
 public:
  void cancel() { cancelled_->store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_->load(std::memory_order_relaxed); }

  StopToken token() const {
    StopToken token;
    token.cancelled_ = cancelled_;
    return token;
  }
  // The limit runs from this call.
  StopToken token(std::chrono::duration<double> limit) const {
    StopToken token = this->token();
    token.deadline_ =
        StopToken::Clock::now() + std::chrono::duration_cast<StopToken::Clock::duration>(limit);
    return token;
  }

 private:
  std::shared_ptr<std::atomic<bool>> cancelled_ = std::make_shared<std::atomic<bool>>(false);
};

// Thrown inside a computation whose token asks to stop; the public doors (Planner::plan,
// PathPlanner) turn it into the status it stands for.
class Stopped {
 public:
  explicit Stopped(StopReason reason) : reason_(reason) {}
  Status status() const {
    return reason_ == StopReason::TIMEOUT ? Status::TIMEOUT : Status::CANCELLED;
  }

 private:
  StopReason reason_;
};

// Asks a token once in `interval` calls and throws Stopped. Put one before a loop, call it inside.
class StopPoll {
 public:
  explicit StopPoll(const StopToken& token, std::uint32_t interval = 2048)
      : token_(token), interval_(interval) {}

  void operator()() {
    const StopReason reason = ask();
    if (reason != StopReason::NONE) throw Stopped(reason);
  }

  // For a caller that still has something to say: NONE, or the reason.
  StopReason ask() {
    if (++calls_ < interval_) return StopReason::NONE;
    calls_ = 0;
    return token_.reason();
  }

 private:
  const StopToken& token_;
  std::uint32_t interval_;
  std::uint32_t calls_ = 0;
};

}  // namespace grid_path_planner::base
