// Whether an update of the map was lost between its publisher and here: by header.seq, which roscpp
// and rospy count for every publisher of a topic.
//
//   if (sequence.missed(event.getPublisherName(), message.header.seq)) askForAWholeMap();
//
// Not noticed: what was lost before the first message of a publisher; publishers do not connect
// without a whole map. A publisher that begins again, or that does not count, has lost nothing.
#pragma once

#include <cstdint>
#include <string>

namespace grid_path_planner::nodes {

class UpdateSequence {
 public:
  // How many messages are missing before this one.
  std::uint32_t missed(const std::string& publisher, std::uint32_t number) {
    const bool follows = publisher == publisher_ && number > last_;
    const std::uint32_t missing = follows ? number - last_ - 1 : 0;
    publisher_ = publisher;
    last_ = number;
    return missing;
  }

 private:
  std::string publisher_;
  std::uint32_t last_ = 0;
};

}  // namespace grid_path_planner::nodes
