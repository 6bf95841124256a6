#include "planning/via/visiting_order.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>

namespace grid_path_planner::planning {

using base::StopPoll, base::StopToken;

namespace {

using Order = std::vector<std::size_t>;
constexpr double kRounding = 1e-12;  // relative, of sums in another order
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// For every set of via-points and each of them as the last: the least cost from the start through all.
class SubsetTable {
 public:
  SubsetTable(const LegCosts& costs, const StopToken& stop)
      : costs_(costs), count_(costs.viaPoints()), sets_(std::size_t{1} << count_) {
    best_.assign(sets_ * count_, kInfinity);
    before_.assign(sets_ * count_, 0);
    StopPoll poll(stop);
    for (std::size_t last = 0; last < count_; ++last)
      best_[entry(std::size_t{1} << last, last)] = costs_.at(costs_.start(), costs_.via(last));
    for (std::size_t set = 1; set < sets_; ++set)
      for (std::size_t last = 0; last < count_; ++last) {
        poll();
        if (has(set, last)) extend(set, last);
      }
  }

  Order order() const {
    std::size_t set = sets_ - 1, last = bestEnd();
    Order order(count_);
    for (std::size_t i = count_; i-- > 0;) {
      order[i] = last;
      const std::size_t before = before_[entry(set, last)];
      set &= ~(std::size_t{1} << last);
      last = before;
    }
    return order;
  }

 private:
  static bool has(std::size_t set, std::size_t via) { return (set >> via & 1) != 0; }
  std::size_t entry(std::size_t set, std::size_t last) const { return set * count_ + last; }

  void extend(std::size_t set, std::size_t last) {
    for (std::size_t next = 0; next < count_; ++next) {
      if (has(set, next)) continue;
      const std::size_t with = entry(set | std::size_t{1} << next, next);
      const double cost = best_[entry(set, last)] + costs_.at(costs_.via(last), costs_.via(next));
      if (cost >= best_[with]) continue;
      best_[with] = cost;
      before_[with] = static_cast<std::uint8_t>(last);
    }
  }

  std::size_t bestEnd() const {
    std::size_t end = 0;
    const auto cost = [&](std::size_t last) {
      return best_[entry(sets_ - 1, last)] + costs_.at(costs_.via(last), costs_.goal());
    };
    for (std::size_t last = 1; last < count_; ++last)
      if (cost(last) < cost(end)) end = last;
    return end;
  }

  const LegCosts& costs_;
  std::size_t count_, sets_;
  std::vector<double> best_;
  std::vector<std::uint8_t> before_;
};

class LocalSearch {
 public:
  LocalSearch(const LegCosts& costs, const StopToken& stop) : costs_(costs), poll_(stop, 64) {
    insertAtLeastCost();
    improve();
  }

  // The best order of local searches that begin where two stretches of the best one are exchanged.
  Order best() {
    std::minstd_rand random(1);
    constexpr int kBeginnings = 40;
    Order best = order_;
    double least = cost_;
    for (int i = 0; i < kBeginnings; ++i) {
      order_ = best;
      exchangeStretches(random);
      cost_ = costs_.ofOrder(order_);
      improve();
      if (!(cost_ < least)) continue;
      best = order_;
      least = cost_;
    }
    return best;
  }

 private:
  void insertAtLeastCost() {
    for (std::size_t via = 0; via < costs_.viaPoints(); ++via) {
      Order found;
      double least = kInfinity;
      for (std::size_t at = 0; at <= order_.size(); ++at) {
        Order longer = order_;
        longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), via);
        const double cost = costOf(longer);
        if (!found.empty() && !(cost < least)) continue;
        least = cost;
        found = std::move(longer);
      }
      order_ = std::move(found);
      cost_ = least;
    }
  }

  // Until neither the reversal of a stretch nor its move elsewhere makes the order cheaper.
  void improve() {
    while (reverseOne() || moveOne()) {
    }
  }

  bool reverseOne() {
    const auto begin = order_.begin();
    const std::ptrdiff_t count = order_.end() - begin;
    for (std::ptrdiff_t from = 0; from < count; ++from)
      for (std::ptrdiff_t to = from + 2; to <= count; ++to) {
        std::reverse(begin + from, begin + to);
        if (isCheaper()) return true;
        std::reverse(begin + from, begin + to);
      }
    return false;
  }

  // Stretches of one to three, towards the goal or the start.
  bool moveOne() {
    const auto count = static_cast<std::ptrdiff_t>(order_.size());
    for (std::ptrdiff_t length = 1; length <= 3; ++length)
      for (std::ptrdiff_t from = 0; from + length < count; ++from)
        for (std::ptrdiff_t to = from + length + 1; to <= count; ++to)
          if (rotates(from, from + length, to) || rotates(from, to - length, to)) return true;
    return false;
  }

  // Whether it is cheaper with the stretches before and after `middle` exchanged; then they are.
  bool rotates(std::ptrdiff_t from, std::ptrdiff_t middle, std::ptrdiff_t to) {
    const auto begin = order_.begin();
    std::rotate(begin + from, begin + middle, begin + to);
    if (isCheaper()) return true;
    std::rotate(begin + from, begin + to - (middle - from), begin + to);
    return false;
  }

  bool isCheaper() {
    const double cost = costOf(order_);
    if (!(cost < cost_ * (1.0 - kRounding))) return false;
    cost_ = cost;
    return true;
  }

  double costOf(const Order& order) {
    poll_();
    return costs_.ofOrder(order);
  }

  // Two neighbouring stretches change places (the double bridge of Martin, Otto and Felten 1991).
  void exchangeStretches(std::minstd_rand& random) {
    std::array<std::ptrdiff_t, 3> cuts;
    for (std::ptrdiff_t& cut : cuts)
      cut = static_cast<std::ptrdiff_t>(random() % (order_.size() + 1));
    std::sort(cuts.begin(), cuts.end());
    std::rotate(order_.begin() + cuts[0], order_.begin() + cuts[1], order_.begin() + cuts[2]);
  }

  const LegCosts& costs_;
  StopPoll poll_;
  Order order_;
  double cost_ = 0.0;
};

}  // namespace

double LegCosts::ofOrder(const std::vector<std::size_t>& order) const {
  double sum = 0.0;
  std::size_t from = start();
  for (const std::size_t index : order) {
    sum += at(from, via(index));
    from = via(index);
  }
  return sum + at(from, goal());
}

VisitingOrder bestVisitingOrder(const LegCosts& costs, const StopToken& stop) {
  if (costs.viaPoints() == 0) return {};
  if (costs.viaPoints() <= kMostExact) return {SubsetTable(costs, stop).order(), true};
  return {improvedVisitingOrder(costs, stop), false};
}

std::vector<std::size_t> improvedVisitingOrder(const LegCosts& costs, const StopToken& stop) {
  return LocalSearch(costs, stop).best();
}

}  // namespace grid_path_planner::planning
