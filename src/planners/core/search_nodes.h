// The search node of every cell of a map: the key of its g-value, the step that led there, and whether
// it is closed.
//
// Nothing is cleared between queries: a node has the stamp of the query that wrote it
// (stamped_array.h). Both classes have the same functions. PackedNodes are faster and smaller; they
// hold costs up to 3.2 million cell lengths x weight.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/zeroed_array.h"
#include "planners/core/keys.h"
#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

// 8 bytes a cell: 12 bits of stamp, 43 of largest key - key, 8 of steps, 1 of closed. In this order
// one comparison of words finds whether a new cost is better: of a later query, or less.
class PackedNodes {
 public:
  static constexpr KeyScale kScale = kPackedScale;
  static constexpr std::size_t kBytes = sizeof(std::uint64_t);

  PackedNodes() = default;
  explicit PackedNodes(std::size_t size) : nodes_(size) {}
  std::size_t size() const { return nodes_.size(); }

  void beginQuery();

  bool generated(std::uint32_t index) const { return stamp_.wrote(nodes_[index]); }

  // Precondition of the following: the cell was generated in this query.
  SearchKey cost(std::uint32_t index) const {
    return kScale.largest - (nodes_[index] >> kKeyShift & kScale.largest);
  }
  std::uint32_t steps(std::uint32_t index) const { return nodes_[index] >> kStepShift & 0xFFU; }
  bool closed(std::uint32_t index) const { return (nodes_[index] & 1) != 0; }
  void close(std::uint32_t index) { nodes_[index] |= 1; }

  void setStart(std::uint32_t start) {
    nodes_[start] = stamp_.word() | kScale.largest << kKeyShift;
  }

  // Whether that is less than its g-value, or it has none. A key above the largest is: the caller must
  // refuse it.
  bool isBetter(std::uint32_t index, SearchKey key) const {
    return valueOf(key) > (nodes_[index] | kRest);
  }
  // Writes a better cost. Returns whether the cell was closed in this query.
  bool improve(std::uint32_t index, SearchKey key, unsigned step) {
    const std::uint64_t known = nodes_[index];
    nodes_[index] = valueOf(key) | bitOf(step);
    return stamp_.wrote(known) && (known & 1) != 0;
  }

 private:
  static constexpr unsigned kStepShift = 1;
  static constexpr unsigned kKeyShift = 9;
  static constexpr unsigned kQueryShift = 52;
  static constexpr std::uint64_t kRest = (std::uint64_t{1} << kKeyShift) - 1;

  static std::uint64_t bitOf(unsigned step) { return std::uint64_t{1} << kStepShift << step; }
  std::uint64_t valueOf(SearchKey key) const {
    return stamp_.word() | (kScale.largest - key) << kKeyShift;
  }

  base::ZeroedArray<std::uint64_t> nodes_;
  QueryStamp<std::uint64_t, kQueryShift> stamp_;
};

// 12 bytes a cell: any key, and a word of query, steps and closed.
class WideNodes {
 public:
  static constexpr KeyScale kScale = kWideScale;
  static constexpr std::size_t kBytes = sizeof(SearchKey) + sizeof(std::uint32_t);

  WideNodes() = default;
  explicit WideNodes(std::size_t size) : costs_(size), words_(size) {}
  std::size_t size() const { return costs_.size(); }

  void beginQuery();

  bool generated(std::uint32_t index) const { return stamp_.wrote(words_[index]); }
  SearchKey cost(std::uint32_t index) const { return costs_[index]; }
  std::uint32_t steps(std::uint32_t index) const { return words_[index] >> kStepShift & 0xFFU; }
  bool closed(std::uint32_t index) const { return (words_[index] & 1) != 0; }
  void close(std::uint32_t index) { words_[index] |= 1; }

  void setStart(std::uint32_t start) {
    words_[start] = stamp_.word();
    costs_[start] = 0;
  }

  bool isBetter(std::uint32_t index, SearchKey key) const {
    return !stamp_.wrote(words_[index]) || key < costs_[index];
  }
  bool improve(std::uint32_t index, SearchKey key, unsigned step) {
    const std::uint32_t known = words_[index];
    words_[index] = stamp_.word() | bitOf(step);
    costs_[index] = key;
    return stamp_.wrote(known) && (known & 1) != 0;
  }

 private:
  static constexpr unsigned kStepShift = 1;
  static constexpr unsigned kQueryShift = 9;

  static std::uint32_t bitOf(unsigned step) { return std::uint32_t{1} << kStepShift << step; }

  base::ZeroedArray<SearchKey> costs_;
  base::ZeroedArray<std::uint32_t> words_;
  QueryStamp<std::uint32_t, kQueryShift> stamp_;
};

}  // namespace grid_path_planner::planners
