// Numbers, texts and frames as the bytes of a flight log, and back.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::avoidance {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "flight logs are little-endian");

class LogWriter {
 public:
  template <class Number>
  void number(Number value) {
    const auto* from = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof(value));
  }
  void text(const std::string& text);
  void points(const std::vector<Eigen::Vector3d>& points);
  void velocity(const base::BodyVelocity& velocity);
  void frame(const Frame& frame);
  void input(const PilotInput& input);
  void answer(const PilotAnswer& answer);

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
};

// Throws InputError where the bytes end too early.
class LogReader {
 public:
  explicit LogReader(const std::vector<char>& bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    require(sizeof(Number));
    Number value;
    std::memcpy(&value, &bytes_[at_], sizeof(value));
    at_ += sizeof(value);
    return value;
  }
  std::string text();
  std::vector<Eigen::Vector3d> points();
  base::BodyVelocity velocity();
  Frame frame();
  // Its frame is kept in `frame`.
  PilotInput input(Frame& frame);
  std::vector<char> rest() const { return {bytes_.begin() + static_cast<long>(at_), bytes_.end()}; }

 private:
  void require(std::uint64_t size) const;

  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

}  // namespace grid_path_planner::avoidance
