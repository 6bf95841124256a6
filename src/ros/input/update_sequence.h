// Whether an update of the map was lost between its publisher and here: by header.seq, which roscpp
// and rospy count for every publisher of a topic.
//
//   if (sequence.note(event.getPublisherName(), message.header.seq).missing > 0) askForAWholeMap();
//
// Not noticed: what was lost before the first message of a publisher; publishers do not connect
// without a whole map. A publisher that begins again, or that does not count, has lost nothing. Of more than
// eight publishers those that were heard last are known.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

namespace grid_path_planner::nodes {

class UpdateSequence {
 public:
  struct Gap {
    std::uint32_t missing = 0;  // messages before this one
    bool began_again = false;   // the publisher counts anew
  };

  Gap note(const std::string& publisher, std::uint32_t number) {
    const auto known = std::find_if(known_.begin(), known_.end(),
                                    [&](const Publisher& each) { return each.name == publisher; });
    Gap gap;
    if (known != known_.end()) {
      gap.missing = number > known->last ? number - known->last - 1 : 0;
      gap.began_again = number < known->last;
      known_.erase(known);
    }
    known_.push_back({publisher, number});
    if (known_.size() > kMostPublishers) known_.pop_front();
    return gap;
  }

 private:
  static constexpr std::size_t kMostPublishers = 8;

  struct Publisher {
    std::string name;
    std::uint32_t last;
  };

  std::deque<Publisher> known_;  // the one that was heard last at the end
};

}  // namespace grid_path_planner::nodes
