// A value that is too large to be copied for each change (committed.h) and is changed in place: what an error
// leaves half done is given up as a whole, and made anew when it is needed next.
//
//   Rebuildable<Costmaps, Stopped> costmaps([&] { return Costmaps(options); });
//   costmaps.change([&](Costmaps& maps) { maps.update(map); });
//
// Guaranteed: no change begins with a value that another one left half done. Errors of the types `Answers`
// leave it whole: whoever throws them says so.
#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace grid_path_planner::base {

template <class T, class... Answers>
class Rebuildable {
 public:
  explicit Rebuildable(std::function<T()> make) : make_(std::move(make)) {}

  // What work(value) gives. Throws what it throws, and what the making does.
  template <class Work>
  decltype(auto) change(Work&& work) {
    if (!value_) value_.emplace(make_());
    try {
      return std::forward<Work>(work)(*value_);
    } catch (...) {
      if (!(isNow<Answers>() || ...)) value_.reset();
      throw;
    }
  }

  // The value that is there, whole, or null. For what leaves it whole whatever it throws.
  T* get() { return value_ ? &*value_ : nullptr; }

 private:
  // Precondition: called in a catch block.
  template <class Error>
  static bool isNow() {
    try {
      throw;
    } catch (const Error&) {
      return true;
    } catch (...) {
      return false;
    }
  }

  std::function<T()> make_;
  std::optional<T> value_;
};

}  // namespace grid_path_planner::base
