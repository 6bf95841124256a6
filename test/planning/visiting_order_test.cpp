// The order of via-points against all orders there are, and against what is known of circles.
#include "planning/via/visiting_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace grid_path_planner::planning {

using base::Stopped;
using base::StopSource;
using base::StopToken;

namespace {

LegCosts randomCosts(std::mt19937& random, std::size_t via_points) {
  LegCosts costs(via_points);
  std::uniform_int_distribution<int> cost(0, 100);
  for (std::size_t from = 0; from < via_points + 2; ++from)
    for (std::size_t to = 0; to < via_points + 2; ++to) costs.at(from, to) = cost(random);
  return costs;
}

// Places in a square; the goal is the start.
LegCosts roundTrip(std::mt19937& random, std::size_t via_points) {
  std::uniform_real_distribution<double> place(0.0, 100.0);
  std::vector<std::pair<double, double>> places(via_points + 2);
  for (auto& each : places) each = {place(random), place(random)};
  places.back() = places.front();
  LegCosts costs(via_points);
  for (std::size_t from = 0; from < places.size(); ++from)
    for (std::size_t to = 0; to < places.size(); ++to)
      costs.at(from, to) = std::hypot(places[from].first - places[to].first,
                                      places[from].second - places[to].second);
  return costs;
}

std::vector<std::size_t> inTurn(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

double leastOfAllOrders(const LegCosts& costs) {
  std::vector<std::size_t> order = inTurn(costs.viaPoints());
  double least = std::numeric_limits<double>::infinity();
  do {
    least = std::min(least, costs.ofOrder(order));
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

bool visitsEachOnce(std::vector<std::size_t> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  return order == inTurn(count);
}

// The costs differ between the directions; whole numbers, so that sums are exact.
TEST(VisitingOrder, NoneOfAllOrdersCostsLess) {
  std::mt19937 random(17);
  for (int round = 0; round < 200; ++round) {
    const std::size_t count = round % 8;
    const LegCosts costs = randomCosts(random, count);
    const VisitingOrder found = bestVisitingOrder(costs, StopToken());
    ASSERT_TRUE(visitsEachOnce(found.order, count)) << "round " << round;
    EXPECT_TRUE(found.exact);
    EXPECT_EQ(costs.ofOrder(found.order), leastOfAllOrders(costs)) << "round " << round;
  }
}

// Twelve points on a circle, numbered at random: by the symmetry of the round trip two orders are best.
TEST(VisitingOrder, TwelveOnACircleAreVisitedAlongIt) {
  std::vector<std::size_t> numbers = inTurn(kMostExact);
  std::mt19937 random(3);
  std::shuffle(numbers.begin(), numbers.end(), random);
  const auto angle = [&](std::size_t place) {  // the start, and the goal with it, at 0
    const bool via = place > 0 && place <= kMostExact;
    return via ? 2.0 * M_PI * static_cast<double>(numbers[place - 1] + 1) / (kMostExact + 1) : 0.0;
  };
  LegCosts costs(kMostExact);
  for (std::size_t from = 0; from < kMostExact + 2; ++from)
    for (std::size_t to = 0; to < kMostExact + 2; ++to)
      costs.at(from, to) = 2.0 * std::abs(std::sin((angle(from) - angle(to)) / 2.0));
  const VisitingOrder found = bestVisitingOrder(costs, StopToken());
  EXPECT_TRUE(found.exact);
  EXPECT_NEAR(costs.ofOrder(found.order),
              2.0 * (kMostExact + 1) * std::sin(M_PI / (kMostExact + 1)), 1e-9);
}

TEST(VisitingOrder, TheHeuristicComesNearTheBestOfTwelve) {
  std::mt19937 random(5);
  double sum = 0.0;
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    const LegCosts costs = roundTrip(random, kMostExact);
    const std::vector<std::size_t> order = improvedVisitingOrder(costs, StopToken());
    ASSERT_TRUE(visitsEachOnce(order, kMostExact));
    const double best = costs.ofOrder(bestVisitingOrder(costs, StopToken()).order);
    EXPECT_LE(costs.ofOrder(order), best * 1.05) << "round " << round;
    sum += costs.ofOrder(order) / best;
  }
  EXPECT_LE(sum / kRounds, 1.005);
}

// More than twelve on a circle: local search finds it too, and does not say that it is sure.
TEST(VisitingOrder, SaysThatItIsNotSureOfThirteen) {
  std::mt19937 random(7);
  const LegCosts costs = roundTrip(random, kMostExact + 1);
  const VisitingOrder found = bestVisitingOrder(costs, StopToken());
  EXPECT_FALSE(found.exact);
  EXPECT_TRUE(visitsEachOnce(found.order, kMostExact + 1));
  EXPECT_EQ(found.order, bestVisitingOrder(costs, StopToken()).order) << "the same every time";
}

TEST(VisitingOrder, StopsWhenItIsTold) {
  std::mt19937 random(9);
  StopSource stop;
  stop.cancel();
  EXPECT_THROW(bestVisitingOrder(roundTrip(random, kMostExact), stop.token()), Stopped);
  EXPECT_THROW(bestVisitingOrder(roundTrip(random, 40), stop.token()), Stopped);
}

}  // namespace
}  // namespace grid_path_planner::planning
