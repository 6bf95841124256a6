// State that is changed as a whole or not at all: one immutable value behind one pointer.
//
//   Committed<Settings> settings;
//   settings.change([&](Settings& next) { next.options = options; ++next.revision; });
//   std::shared_ptr<const Settings> now = settings.get();  // stays as it is while it is read
//
// A change is made to a copy, which then takes the place of the value. Guaranteed: a change that throws
// changes nothing; a reader sees all of a change or nothing of it; changes of several threads come one after
// the other, and a reader waits for none of them. A change that asks for another one of the same state never
// ends.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace grid_path_planner::base {

template <class State>
class Committed {
 public:
  Committed() : Committed(State()) {}
  explicit Committed(State state) : state_(std::make_shared<const State>(std::move(state))) {}
  Committed(const Committed&) = delete;
  Committed& operator=(const Committed&) = delete;

  std::shared_ptr<const State> get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return state_;
  }

  // Calls change(next) with a copy, which then is the value.
  template <class Change>
  void change(Change&& change) {
    const std::lock_guard<std::mutex> one(changing_);
    auto copy = std::make_shared<State>(*get());
    std::forward<Change>(change)(*copy);
    std::shared_ptr<const State> next = std::move(copy);
    const std::lock_guard<std::mutex> lock(mutex_);
    state_.swap(next);
  }

 private:
  std::mutex changing_;
  mutable std::mutex mutex_;  // of state_, held for no longer than it takes to copy a pointer
  std::shared_ptr<const State> state_;
};

}  // namespace grid_path_planner::base
