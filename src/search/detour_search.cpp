#include "grid_path_planner/search/detour_search.h"

#include <algorithm>

namespace grid_path_planner {

bool DetourSearch::run(const GoalLabels& labels, Index start, SearchKey sound_below, bool record,
                       PlanResult& result, StopPoll& poll) {
  nodes_.begin(labels.geometry().width());
  cost_ = kInfiniteKey;
  reached_ = 0;
  saw_the_end_ = too_dear_ = false;
  const std::uint32_t first = nodeOf(labels, start);
  nodes_[first].arrived |= kReached;
  if (sound(labels, start, sound_below)) {
    cost_ = labels.label(start);
    last_ = first;
    return true;
  }
  nodes_[first].waiting = 1;
  nodes_.push(labels.label(start), first);
  while (nodes_.open()) {
    poll();
    const std::uint32_t number = nodes_.pop();
    Nodes::Node& node = nodes_[number];
    if (node.waiting == 0) continue;
    node.waiting = 0;
    const Index index = indexOf(labels, number);
    reached_ = std::max(reached_, node.g + labels.label(index));
    if (reached_ >= cost_) break;
    ++result.statistics.expanded;
    if (record) result.expanded.emplace_back(index);
    expand(labels, number, sound_below, result.statistics);
  }
  result.statistics.peak_open = std::max(result.statistics.peak_open, nodes_.peakOpen());
  return cost_ != kInfiniteKey;
}

void DetourSearch::expand(const GoalLabels& labels, std::uint32_t number, SearchKey sound_below,
                          Statistics& counts) {
  nodes_[number].arrived |= kExpanded;
  const SearchKey g = nodes_[number].g;
  const Index index = indexOf(labels, number);
  for (unsigned mask = labels.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    const Index to = labels.along(index, step);
    if (labels.state(to) == GoalLabels::UNLABELLED) {
      saw_the_end_ = true;
      continue;
    }
    const SearchKey next_g = g + labels.stepKey(index, to, step);
    if (next_g > kLargestKey - labels.label(to)) {
      too_dear_ = true;
      continue;
    }
    const SearchKey next_f = next_g + labels.label(to);
    if (next_f >= cost_) continue;
    const std::uint32_t next = nodeOf(labels, to);
    if ((nodes_[next].arrived & kReached) != 0 && nodes_[next].g <= next_g) continue;
    nodes_[next].arrived |= kReached;
    nodes_[next].g = next_g;
    nodes_[next].parent = number;
    ++counts.generated;
    if (sound(labels, to, sound_below)) {
      cost_ = next_f;
      last_ = next;
      continue;
    }
    nodes_[next].waiting = 1;
    nodes_.push(std::max(reached_, next_f), next);
  }
}

// Every cell of the ways that are followed here is looked at once.
bool DetourSearch::sound(const GoalLabels& labels, Index index, SearchKey sound_below) {
  bool sound = true;
  way_.clear();
  for (Index at = index; labels.label(at) >= sound_below && at != labels.root();
       at = labels.next(at)) {
    const std::uint32_t number = nodeOf(labels, at);
    const std::uint8_t known = nodes_[number].arrived & (kSound | kUnsound);
    if (known != 0) {
      sound = known == kSound;
      break;
    }
    way_.push_back(number);
    if (labels.supported(at)) continue;
    sound = false;
    break;
  }
  for (const std::uint32_t number : way_) nodes_[number].arrived |= sound ? kSound : kUnsound;
  return sound;
}

void DetourSearch::learn(GoalLabels& labels) const {
  for (std::uint32_t number = 0; number < nodes_.size(); ++number)
    if ((nodes_[number].arrived & kExpanded) != 0)
      labels.raise(indexOf(labels, number), cost_ - nodes_[number].g);
  const GoalLabels::Index start = indexOf(labels, 0);
  for (std::uint32_t number = last_; indexOf(labels, number) != start;) {
    const std::uint32_t before = nodes_[number].parent;
    const Index from = indexOf(labels, before), to = indexOf(labels, number);
    std::uint32_t step = 0;
    while (labels.along(from, step) != to) ++step;
    labels.setWay(from, cost_ - nodes_[before].g, step);
    number = before;
  }
}

}  // namespace grid_path_planner
