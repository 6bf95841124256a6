// Confidence intervals at 95 %.
//
// Times are compared in pairs (the same query on the same setting) and as ratios, since planning
// times spread over decades. A difference counts only where the interval excludes 1. The samples are
// the queries: one query under several weights is not several samples, so every figure is first
// averaged over each query.
#pragma once

#include <cstddef>
#include <vector>

namespace grid_path_planner::study {

struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

// The geometric mean of `ratios` (positive), with Student's t interval of their logarithms. One
// single ratio has no known spread: low 0 and high infinity. Precondition: not empty.
Interval meanRatio(const std::vector<double>& ratios);

// Whether the interval of a ratio excludes 1.
inline bool differs(const Interval& ratio) {
  return ratio.low > 1.0 || ratio.high < 1.0;
}

// The mean of `differences`, with Student's t interval; one alone: from -infinity to infinity.
// Precondition: not empty.
Interval meanDifference(const std::vector<double>& differences);

// The p-value of Student's test, two-sided, that the mean of `differences` is 0. Without spread: 1 for
// a mean of 0, else 0; one alone: 1. Precondition: not empty.
double pairedP(const std::vector<double>& differences);

// The p-value of Welch's test (Welch 1947), two-sided, that two samples with variances of their own have
// one mean. Without any spread: 1 for equal means, else 0. Precondition: at least two values each.
double welchP(const std::vector<double>& a, const std::vector<double>& b);

// The p-value of Fisher's exact test, two-sided (the sum of all tables no likelier than this one), that
// `some_a` of `all_a` and `some_b` of `all_b` come from one share.
double fisherP(std::size_t some_a, std::size_t all_a, std::size_t some_b, std::size_t all_b);

// p-values corrected for several tests by Holm's step-down procedure (Holm 1979): the smallest of n
// times n, the next times n - 1, and so on, none less than the one before and none above 1. The
// chance of rejecting any true hypothesis is then at most that of one test. In the order given.
std::vector<double> holmCorrected(const std::vector<double>& p_values);

// `some` of `all` as a share, with Wilson's score interval (Wilson 1927), which holds for small
// numbers and shares near 0 and 1 too, for `samples` independent ones among them. Precondition:
// all > 0, samples > 0.
Interval share(std::size_t some, std::size_t all, std::size_t samples);

// The share of the sorted values below `part` of them (0.5: the median), linearly between two.
// Precondition: not empty.
double quantileOf(std::vector<double> values, double part);

}  // namespace grid_path_planner::study
