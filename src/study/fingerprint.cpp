#include "study/fingerprint.h"

#include "grid_path_planner/base/files.h"

namespace grid_path_planner::study {

void Fingerprint::addText(const std::string& text) {
  addNumber(static_cast<std::int64_t>(text.size()));
  addBytes(text.data(), text.size());
}

void Fingerprint::addNumber(double number) {
  addBytes(&number, sizeof number);
}

void Fingerprint::addNumber(std::int64_t number) {
  addBytes(&number, sizeof number);
}

void Fingerprint::addFile(const std::string& file) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;  // bytes: a file may be larger than memory
  const base::RegularFile content(file);
  std::size_t size = 0;
  for (std::string piece; !(piece = content.read(size, kPiece)).empty(); size += piece.size())
    addBytes(piece.data(), piece.size());
  addNumber(static_cast<std::int64_t>(size));
}

void Fingerprint::addBytes(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
}

}  // namespace grid_path_planner::study
