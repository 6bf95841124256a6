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
    RISING,  // by stamp: each waits for the one before, and until ROS time is at its stamp; a message that is not newer than
             // the last of the same frame_id is refused
    NEWEST,  // not newer is refused too; one that waits is dropped where a newer one of its frame can be used
  };
  enum class Silence {
    BY_ARRIVAL,  // since the last that was used came, by the wall clock: it goes on where /clock stands
    BY_STAMP,  // since the stamp of the newest that was used, by ROS time: what rests on it is as old as that
  };

  Stamp stamp = Stamp::REQUIRED;
  bool frame_required =
      true;  // false: a message without frame_id counts as in each of `frames` itself
  double most_ahead =
      10.0;  // s after ROS time; a message further ahead is refused. Within it RISING waits for its time
  double oldest =
      10.0;  // s before ROS time, when it comes; older is refused. The default is what tf keeps
  Order order = Order::RISING;
  std::vector<std::string> frames;  // tf must lead from the message's frame into each, at its stamp
  double tf_wait =
      1.0;  // s of the wall clock from its arrival, for tf and ROS time; then it is refused
  // Messages that wait for tf, and as many again that wait to be used; beyond it one is dropped (input_judge.h says which).
  // 1: of those that roscpp has, the newest alone is unpacked.
  std::size_t most_waiting = 10;
  std::size_t most_bytes =
      64 * kMebibyte;  // of all that wait together; one message alone may be larger
  double silent_after =
      kNever;  // s without a message that is used, also before the first; then problem()
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
