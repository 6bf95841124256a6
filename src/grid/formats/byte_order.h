// Numbers as bytes, the lowest first whatever the machine, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace grid_path_planner::grid {

inline void putInteger(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

inline void putDouble(std::string& bytes, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  putInteger(bytes, bits, sizeof bits);
}

// Precondition: the bytes are there.
inline std::uint64_t integerAt(const std::string& bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)])}
             << (8 * i);
  return value;
}

inline double doubleAt(const std::string& bytes, std::size_t at) {
  const std::uint64_t bits = integerAt(bytes, at, sizeof bits);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// 7 bits a byte, the lowest first; the eighth bit says that more follow.
inline void putVarying(std::string& bytes, std::uint64_t value) {
  for (; value > 0x7f; value >>= 7) bytes += static_cast<char>(value | 0x80);
  bytes += static_cast<char>(value);
}

}  // namespace grid_path_planner::grid
