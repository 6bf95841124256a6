// How much came from one input, and why what was refused was.
//
//   InputRecord record("camera/image_raw");
//   record.receive();
//   record.refuse(error.what());
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <string>
#include <utility>

namespace grid_path_planner::nodes {

class InputRecord {
 public:
  // `name` is what the log calls it.
  explicit InputRecord(std::string name) : name_(std::move(name)) {}

  void receive() { ++received_; }
  // Into the log too: the first at once, then at most one line in 5 s.
  void refuse(const std::string& reason);

  std::uint64_t received() const { return received_; }
  std::uint64_t refused() const { return refused_; }
  const std::string& reason() const { return reason_; }  // of the newest refusal

 private:
  std::string name_;
  std::uint64_t received_ = 0, refused_ = 0;
  std::string reason_;
  ros::SteadyTime logged_;
};

}  // namespace grid_path_planner::nodes
