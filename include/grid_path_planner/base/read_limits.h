// What reading one file may take. A few bytes can claim a map of 2^31 cells, unpack to a thousand times
// their number, or ask for more steps than anyone waits for; so every reader of the package asks
// these limits before it takes memory, and again and again while it works.
//
//   ReadLimits limits(options, stop_token);
//   limits.start();                                       // the time runs from here
//   limits.take(file, cells);                             // before the cells are made
//   for (ReadPoll poll(limits, file); row < height; ++row) poll(), readRow(row);
//
// All failures are InputErrors that name the file and the option to raise. Not counted: what the
// caller makes of the result afterwards.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::base {

struct ReadOptions {
  int read_memory_limit = 2000;   // MB
  double read_time_limit = 30.0;  // s
};

template <class Visitor>
void visitOptions(ReadOptions& o, Visitor&& visit) {
  visit(
      "read_memory_limit", o.read_memory_limit,
      OptionInfo{
          "Memory that reading one file may take, with what is made of it; never more than half of "
          "what is available at the start; a file that needs more is refused before it is taken",
          "MB", 1, 1e6}
          .under("Reading files"));
  visit("read_time_limit", o.read_time_limit,
        OptionInfo{"Time that reading one file may take; then it is refused", "s", 0.01, 86400});
}

class ReadLimits {
 public:
  // `stop` ends the reading at once.
  ReadLimits(const ReadOptions& options = {}, StopToken stop = {});  // NOLINT: options are limits

  // For work whose results must not depend on how busy the machine is: `read_time_limit` is the processor
  // time of a process that reads (child_process.h). By the clock the reading has 60 times as long, which
  // ends a process that sleeps.
  static ReadLimits ofProcessorTime(const ReadOptions& options = {});

  // None but `stop`: for what this package has kept for itself, which is lost where it is refused. Memory that the
  // system does not give is std::bad_alloc then, since the file is as good as before.
  static ReadLimits none(StopToken stop);
  bool isNone() const { return none_; }

  // The time runs from the first of these calls on; later ones change nothing.
  void start();

  // `bytes` are about to be taken in addition to all before. Throws InputError where there are not so
  // many left; nothing is to be taken then.
  void take(const std::string& file, std::size_t bytes);
  // The same question without an answer that is kept.
  void check(const std::string& file, std::size_t bytes) const;

  // Throws InputError where the time is over, or `stop` was cancelled.
  void goOn(const std::string& file) const;
  // Whether goOn() would return: for callbacks that must not throw.
  bool mayGoOn() const;

  std::size_t bytesLeft() const { return bytes_ - taken_; }
  // The processor time that a process that reads may take: no more than what is left by the clock, at
  // least 0; all of it before start().
  double processorSeconds() const;
  bool stopped() const { return stop_.reason() != StopReason::NONE; }

  // Errors, for readers that find out by themselves.
  InputError tooLarge(const std::string& file) const;
  InputError tooSlow(const std::string& file) const;

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t bytes_;
  std::size_t taken_ = 0;
  double seconds_, clock_seconds_;
  bool none_ = false;
  StopToken stop_;
  std::optional<Clock::time_point> end_;
};

// Asks limits once in `interval` calls.
class ReadPoll {
 public:
  // Both outlive this.
  ReadPoll(const ReadLimits& limits, const std::string& file, std::uint32_t interval = 1024)
      : limits_(limits), file_(file), interval_(interval) {}

  void operator()() {
    if (++calls_ < interval_) return;
    calls_ = 0;
    limits_.goOn(file_);
  }

 private:
  const ReadLimits& limits_;
  const std::string& file_;
  std::uint32_t interval_;
  std::uint32_t calls_ = 0;
};

// What `read` makes of the file within `limits`, whose time runs from here. Memory that the system does
// not give, within the limits or not, is an InputError too, but without limits.
template <class Read>
auto readWithin(const std::string& file, ReadLimits limits, const Read& read) {
  limits.start();
  try {
    return read(limits);
  } catch (const std::bad_alloc&) {
    if (limits.isNone()) throw;
    throw InputError(file, "cannot be read: there is not enough memory");
  }
}

}  // namespace grid_path_planner::base
