#include "study/confidence.h"

#include <algorithm>
#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace grid_path_planner::study {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTail = 0.025;           // on either side: 95 % confidence
constexpr double kNormalTail = 1.959964;  // standard deviations with kTail outside

}  // namespace

Interval meanDifference(const std::vector<double>& differences) {
  const auto n = static_cast<double>(differences.size());
  double mean = 0.0, squares = 0.0;
  for (const double difference : differences) mean += difference / n;
  for (const double difference : differences) squares += std::pow(difference - mean, 2);
  if (differences.size() == 1) return {mean, -kInfinity, kInfinity};
  const boost::math::students_t distribution(n - 1.0);
  const double half = boost::math::quantile(boost::math::complement(distribution, kTail)) *
                      std::sqrt(squares / (n - 1.0) / n);
  return {mean, mean - half, mean + half};
}

Interval meanRatio(const std::vector<double>& ratios) {
  std::vector<double> logarithms;
  for (const double ratio : ratios) logarithms.push_back(std::log(ratio));
  const Interval mean = meanDifference(logarithms);
  return {std::exp(mean.value), std::exp(mean.low), std::exp(mean.high)};
}

double pairedP(const std::vector<double>& differences) {
  if (differences.size() < 2) return 1.0;
  const Interval mean = meanDifference(differences);
  const boost::math::students_t distribution(static_cast<double>(differences.size()) - 1.0);
  const double error = (mean.high - mean.value) /
                       boost::math::quantile(boost::math::complement(distribution, kTail));
  if (error == 0.0) return mean.value == 0.0 ? 1.0 : 0.0;
  return 2.0 *
         boost::math::cdf(boost::math::complement(distribution, std::abs(mean.value) / error));
}

double welchP(const std::vector<double>& a, const std::vector<double>& b) {
  const auto spreadOf = [](const std::vector<double>& values, double mean) {
    double squares = 0.0;
    for (const double value : values) squares += std::pow(value - mean, 2);
    const auto n = static_cast<double>(values.size());
    return squares / (n - 1.0) / n;
  };
  const double mean_a = meanDifference(a).value, mean_b = meanDifference(b).value;
  const double spread_a = spreadOf(a, mean_a), spread_b = spreadOf(b, mean_b);
  const double spread = spread_a + spread_b;
  if (spread == 0.0) return mean_a == mean_b ? 1.0 : 0.0;
  const auto free = [](const std::vector<double>& values) {
    return static_cast<double>(values.size()) - 1.0;
  };
  const boost::math::students_t distribution(
      spread * spread / (spread_a * spread_a / free(a) + spread_b * spread_b / free(b)));
  return 2.0 * boost::math::cdf(boost::math::complement(
                   distribution, std::abs(mean_a - mean_b) / std::sqrt(spread)));
}

double fisherP(std::size_t some_a, std::size_t all_a, std::size_t some_b, std::size_t all_b) {
  const auto some = static_cast<unsigned>(some_a + some_b);
  const boost::math::hypergeometric distribution(some, static_cast<unsigned>(all_a),
                                                 static_cast<unsigned>(all_a + all_b));
  const unsigned least = some > all_b ? some - static_cast<unsigned>(all_b) : 0;
  const unsigned most = std::min(some, static_cast<unsigned>(all_a));
  const double here = boost::math::pdf(distribution, static_cast<unsigned>(some_a));
  double p = 0.0;
  for (unsigned i = least; i <= most; ++i) {
    const double there = boost::math::pdf(distribution, i);
    if (there <= here * (1.0 + 1e-9)) p += there;
  }
  return std::min(1.0, p);
}

std::vector<double> holmCorrected(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&p_values](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> corrected(p_values.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto left = static_cast<double>(order.size() - rank);
    largest = std::min(1.0, std::max(largest, left * p_values[order[rank]]));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

Interval share(std::size_t some, std::size_t all, std::size_t samples) {
  const auto n = static_cast<double>(samples);
  const double p = static_cast<double>(some) / static_cast<double>(all);
  const double z2 = kNormalTail * kNormalTail;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormalTail * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

double quantileOf(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  const double place = part * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace grid_path_planner::study
