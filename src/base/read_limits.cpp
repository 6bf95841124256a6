#include "grid_path_planner/base/read_limits.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/available_memory.h"
#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::base {
namespace {

constexpr std::size_t kMegabyte = 1000000;
constexpr double kPatience = 60.0;  // seconds by the clock for each of processor time
constexpr double kEndless = 1e8;    // s

}  // namespace

ReadLimits::ReadLimits(const ReadOptions& options, StopToken stop)
    : bytes_(std::min(static_cast<std::size_t>(options.read_memory_limit) * kMegabyte,
                      halfOfAvailableMemory())),
      seconds_(options.read_time_limit),
      clock_seconds_(seconds_),
      stop_(std::move(stop)) {}

ReadLimits ReadLimits::ofProcessorTime(const ReadOptions& options) {
  ReadLimits limits(options);
  limits.clock_seconds_ *= kPatience;
  return limits;
}

ReadLimits ReadLimits::none(StopToken stop) {
  ReadLimits limits({}, std::move(stop));
  limits.bytes_ = std::numeric_limits<std::size_t>::max();
  limits.seconds_ = limits.clock_seconds_ = kEndless;
  limits.none_ = true;
  return limits;
}

void ReadLimits::start() {
  if (end_) return;
  end_ = Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(clock_seconds_));
}

void ReadLimits::take(const std::string& file, std::size_t bytes) {
  check(file, bytes);
  taken_ += bytes;
}

void ReadLimits::check(const std::string& file, std::size_t bytes) const {
  if (bytes <= bytesLeft()) return;
  const std::size_t needed = taken_ + std::min(bytes, std::size_t{1} << 60);
  throw InputError(file, "takes " + std::to_string(needed / kMegabyte) +
                             " MB to be read, more than the " + std::to_string(bytes_ / kMegabyte) +
                             " MB that reading a file may take (read_memory_limit)");
}

void ReadLimits::goOn(const std::string& file) const {
  if (stopped()) throw InputError(file, "was not read to its end: reading was cancelled");
  if (!mayGoOn()) throw tooSlow(file);
}

bool ReadLimits::mayGoOn() const {
  return !stopped() && (!end_ || Clock::now() < *end_);
}

double ReadLimits::processorSeconds() const {
  if (!end_) return seconds_;
  const double left = std::chrono::duration<double>(*end_ - Clock::now()).count();
  return std::clamp(left, 0.0, seconds_);
}

InputError ReadLimits::tooLarge(const std::string& file) const {
  return InputError(file, "takes more than the " + std::to_string(bytes_ / kMegabyte) +
                              " MB that reading a file may take (read_memory_limit)");
}

InputError ReadLimits::tooSlow(const std::string& file) const {
  return InputError(file, "takes longer to be read than the " + decimalText(seconds_) +
                              " s that reading a file may take (read_time_limit)");
}

}  // namespace grid_path_planner::base
