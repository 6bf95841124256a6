// Costs without rounding. A path over grid steps costs A + B sqrt 2 with integers A and B; the two
// are kept apart and rounded only by toDouble().
//
// Searches order costs by one integer, A*Q + B*P with the convergent P/Q = 4478554083/3166815962 of
// sqrt 2: for B < Q the order is that of A + B sqrt 2, ties included (a fraction with a smaller
// denominator is never nearer), and P/Q > sqrt 2 keeps the Euclidean heuristic consistent.
#pragma once

#include <cstdint>

namespace grid_path_planner::costmap {

struct ExactCost {
  std::int64_t straight = 0;  // A
  std::int64_t diagonal = 0;  // B

  double toDouble() const;  // A + B sqrt 2, rounded once

  ExactCost& operator+=(const ExactCost& other) {
    straight += other.straight;
    diagonal += other.diagonal;
    return *this;
  }
  friend ExactCost operator+(ExactCost a, const ExactCost& b) { return a += b; }
  friend ExactCost operator-(const ExactCost& a, const ExactCost& b) { return a + b * -1; }
  friend ExactCost operator*(ExactCost a, std::int64_t factor) {
    return {a.straight * factor, a.diagonal * factor};
  }
  friend bool operator==(const ExactCost& a, const ExactCost& b) {
    return a.straight == b.straight && a.diagonal == b.diagonal;
  }
  friend bool operator!=(const ExactCost& a, const ExactCost& b) { return !(a == b); }
  // The order of A + B sqrt 2, without rounding.
  friend bool operator<(const ExactCost& a, const ExactCost& b);
};

}  // namespace grid_path_planner::costmap
