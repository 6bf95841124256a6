// An open list for nodes that are larger than their keys: a binary heap of f-values, and the nodes
// beside it.
//
//   NodeHeap<Node> open;
//   open.push(f, node);
//   if (!open.empty() && open.least() < limit) node = open.pop();
//
// Of equal f-values any may be popped first; the same calls give the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planners/core/binary_heap.h"

namespace grid_path_planner::planners {

template <class Node>
class NodeHeap {
 public:
  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }

  void clear() {
    nodes_.clear();
    unused_.clear();
    heap_.clear();
  }

  void push(double f, const Node& node) {
    std::uint32_t place = static_cast<std::uint32_t>(nodes_.size());
    if (unused_.empty()) {
      nodes_.push_back(node);
    } else {
      place = unused_.back();
      unused_.pop_back();
      nodes_[place] = node;
    }
    heap_.push({f, place});
  }

  // Precondition of both: not empty().
  double least() const { return heap_.top().f; }
  Node pop() {
    const std::uint32_t place = heap_.pop().node;
    unused_.push_back(place);
    return nodes_[place];
  }

  // At its longest since clear().
  std::size_t bytes() const {
    return nodes_.size() * (sizeof(Node) + sizeof(Entry) + sizeof(std::uint32_t));
  }

 private:
  struct Entry {
    double f;
    std::uint32_t node;
  };
  struct Worse {
    bool operator()(const Entry& a, const Entry& b) const { return a.f > b.f; }
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unused_;  // places in nodes_
  BinaryHeap<Entry, Worse> heap_;
};

}  // namespace grid_path_planner::planners
