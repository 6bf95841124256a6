// Which messages of an input are of use: data. The rules of every input of the nodes are one table, of which
// doc/input_rules.md is printed.
//
//   InputRules rules = rulesOf("map_layers", "scan");
//   rules.frames = {options.map_frame};
//   rules.tf_wait = options.tf_timeout;
//
// input.h has who carries them out. No ROS here: the page is printed before there are messages.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kMebibyte = std::size_t{1} << 20;

struct InputRules {
  enum class Stamp {
    REQUIRED,     // one of 0 is refused: nobody knows when it was measured
    ZERO_IS_NOW,  // 0, or none in a message of this type, is the time at which it came
  };
  enum class Order {
    ANY,     // each is used as soon as tf leads to its frame, whatever was used before
    RISING,  // by stamp: each waits for the one before, and until ROS time is at its stamp; one that is not newer than the
             // last of its frame is refused
    NEWEST,  // not newer is refused too; one that waits is dropped where a newer one of its frame can be used
  };
  enum class Silence {
    BY_ARRIVAL,  // since the last that was used came, by the wall clock: it goes on where /clock stands
    BY_STAMP,  // since the stamp of the newest that was used, by ROS time: what rests on it is as old as that
  };

  Stamp stamp = Stamp::REQUIRED;
  bool frame_required =
      true;                  // what a sensor measured has to say where; else no frame is the map's
  double most_ahead = 10.0;  // s after ROS time; beyond it is refused
  double oldest =
      10.0;  // s before ROS time when it comes; older is refused. By default what tf keeps
  Order order = Order::RISING;
  std::vector<std::string> frames;  // tf must lead from the message's into each, at its stamp
  double tf_wait = 1.0;             // s of the wall clock; then it is refused
  std::size_t most_waiting =
      10;  // for tf, and as many to be used; 1: roscpp keeps the newest only, too
  std::size_t most_bytes = 64 * kMebibyte;  // of those that wait, or one message
  double silent_after = kNever;             // s
  Silence silence = Silence::BY_ARRIVAL;
};

// An input of a node, as the table has it.
struct InputRow {
  std::string node;
  std::string topic;
  InputRules rules;        // with the defaults of the node's parameters
  std::string parameters;  // by which the node changes them
  std::string reason;      // why they are so
};

const std::vector<InputRow>& inputTable();

// Throws std::logic_error where the table has no such row.
const InputRules& rulesOf(const std::string& node, const std::string& topic);

// As a table in Markdown, without a newline at its end.
std::string inputTableText();

}  // namespace grid_path_planner::nodes
