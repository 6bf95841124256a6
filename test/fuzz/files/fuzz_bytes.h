// Bytes of an input as numbers and names, for targets that build something from them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace grid_path_planner::fuzz {

class Bytes {
 public:
  explicit Bytes(const std::string& input) : input_(input) {}

  bool empty() const { return at_ >= input_.size(); }
  // Beyond the end: 0.
  std::uint8_t byte() { return empty() ? 0 : static_cast<std::uint8_t>(input_[at_++]); }
  // Any double, of eight bytes, or a small one of one.
  double number() {
    if (byte() % 4 != 0) return (byte() - 128) / 8.0;
    char bytes[sizeof(double)];
    for (char& value : bytes) value = static_cast<char>(byte());
    double number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }
  std::string name() {
    std::string text(byte() % 16, ' ');
    for (char& letter : text) letter = static_cast<char>(byte());
    return text;
  }

 private:
  const std::string& input_;
  std::size_t at_ = 0;
};

}  // namespace grid_path_planner::fuzz
