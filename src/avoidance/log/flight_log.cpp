#include "grid_path_planner/avoidance/flight_log.h"

#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "avoidance/log/log_bytes.h"
#include "avoidance/memory/open_space.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::avoidance {

using base::InputError;
using base::OptionInfo;

namespace {

constexpr const char* kFirstLine = "grid_path_planner flight 2";
constexpr const char* kOptionsEnd = "\n...\n";
constexpr std::size_t kLongestOptions = 1 << 16;                  // bytes
constexpr std::uint64_t kLargestRecord = std::uint64_t{1} << 28;  // bytes
constexpr std::size_t kRecordHead = 9;                            // bytes: its kind and its size

PilotOptions optionsOf(const std::map<std::string, std::string>& lines) {
  PilotOptions options;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo& info) {
    const auto line = lines.find(name);
    if (line == lines.end()) throw InputError(std::string("the option ") + name + " is missing");
    base::parseOption(name, line->second, info, value);
  });
  checkPilotOptions(options);
  return options;
}

// Of lines "name: value".
PilotOptions optionsIn(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::map<std::string, std::string> lines;
  while (std::getline(in, line)) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) throw InputError("an option's line has no colon: " + line);
    lines[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return optionsOf(lines);
}

struct Record {
  char kind = 0;
  std::vector<char> bytes;
};

// The parts of a file, which takes no more memory than the file has bytes, whatever it claims.
class LogFile {
 public:
  explicit LogFile(const std::string& name) : name_(name), file_(name) {}

  // The text between the first line and "...".
  std::string options() {
    const std::string text = file_.read(0, kLongestOptions);
    const std::string first = std::string(kFirstLine) + "\n";
    if (text.compare(0, first.size(), first) != 0)
      throw InputError(std::string("is no flight log: its first line must be '") + kFirstLine +
                       "'");
    const std::size_t end = text.find(kOptionsEnd);
    if (end == std::string::npos) throw InputError("the options do not end");
    at_ = end + std::strlen(kOptionsEnd);
    return text.substr(first.size(), end + 1 - first.size());
  }

  // None at the end, and where the last one is cut off.
  std::optional<Record> next() {
    const std::string head = file_.read(at_, 1 + sizeof(std::uint64_t));
    if (head.size() < 1 + sizeof(std::uint64_t)) return std::nullopt;
    std::uint64_t size = 0;
    std::memcpy(&size, head.data() + 1, sizeof(size));
    if (size > kLargestRecord) throw InputError("a record of " + std::to_string(size) + " bytes");
    at_ += head.size();
    if (at_ > file_.size() || size > file_.size() - at_) return std::nullopt;
    limits_.check(name_, 3 * size);  // its bytes twice, and its frame
    const std::string bytes = file_.read(at_, size);
    if (bytes.size() < size) return std::nullopt;
    at_ += size;
    return Record{head[0], {bytes.begin(), bytes.end()}};
  }

 private:
  const std::string name_;
  const base::RegularFile file_;
  const base::ReadLimits limits_;
  std::size_t at_ = 0;
};

// The pilot of a log, and its answers compared.
class Replay {
 public:
  using Each = std::function<void(const PilotInput&, const PilotAnswer&)>;

  Replay(LogFile& file, Each each)
      : file_(file), pilot_(optionsIn(file.options())), each_(std::move(each)) {
    pilot_.setMapPlan([this](const Eigen::Vector3d&, const Eigen::Vector3d&) {
      return std::exchange(plan_, std::nullopt);
    });
  }

  // A plan on the map is written before the answer that it led to.
  ReplayResult run() {
    while (const std::optional<Record> record = file_.next()) use(*record);
    return result_;
  }

 private:
  void use(const Record& record) {
    LogReader reader(record.bytes);
    switch (record.kind) {
      case 'o':
        return pilot_.setOptions(optionsIn(reader.text()));
      case 'r':
        return pilot_.setRoute(reader.points());
      case 'p':
        return pilot_.setPath(reader.points());
      case 'm':
        plan_ = reader.points();
        return;
      case 'c':
        return pilot_.cancel(reader.text());
      case 'f':
        return pilot_.forget();
      case 's':
        return pilot_.see(reader.frame());
      case 'u':
        return update(reader);
      default:
        throw InputError(std::string("a record of the unknown kind '") + record.kind + "'");
    }
  }

  void update(LogReader& reader) {
    Frame frame;
    const PilotInput input = reader.input(frame);
    const PilotAnswer answer = pilot_.update(input);
    if (each_) each_(input, answer);
    ++result_.updates;
    LogWriter again;
    again.answer(answer);
    if (again.bytes() == reader.rest()) return;
    if (result_.differing++ == 0)
      result_.first_difference = "update " + std::to_string(result_.updates) + " at " +
                                 base::decimalText(input.time) + " s is now " +
                                 toString(answer.status) + ": " + answer.sentence;
  }

  LogFile& file_;
  Pilot pilot_;
  Each each_;
  std::optional<Points> plan_;
  ReplayResult result_;
};

}  // namespace

FlightLog::FlightLog(const base::OutputFile& file, const PilotOptions& options, std::uint64_t limit)
    : out_(file), left_(limit) {
  const std::string head = std::string(kFirstLine) + "\n" + base::optionText(options) + "...\n";
  const std::string problem = out_.write(head.data(), head.size());
  if (!problem.empty()) throw InputError(file.name(), "cannot be written: " + problem);
}

// At once: what a node wrote that is killed is there.
void FlightLog::write(char kind, const std::vector<char>& bytes) {
  const std::uint64_t size = bytes.size();
  if (full()) return;
  if (size > kLargestRecord || size + kRecordHead > left_) {
    problem_ = "its limit is reached";
    return;
  }
  left_ -= size + kRecordHead;
  char head[kRecordHead] = {kind};
  std::memcpy(head + 1, &size, sizeof(size));
  problem_ = out_.write(head, sizeof(head));
  if (!full()) problem_ = out_.write(bytes.data(), bytes.size());
}

void FlightLog::options(const PilotOptions& options) {
  LogWriter writer;
  writer.text(base::optionText(options));
  write('o', writer.bytes());
}

void FlightLog::route(const Points& waypoints) {
  LogWriter writer;
  writer.points(waypoints);
  write('r', writer.bytes());
}

void FlightLog::path(const Points& path) {
  LogWriter writer;
  writer.points(path);
  write('p', writer.bytes());
}

void FlightLog::mapPlan(const Points& plan) {
  LogWriter writer;
  writer.points(plan);
  write('m', writer.bytes());
}

void FlightLog::cancel(const std::string& reason) {
  LogWriter writer;
  writer.text(reason);
  write('c', writer.bytes());
}

void FlightLog::forget() {
  write('f', {});
}

void FlightLog::see(const Frame& frame) {
  LogWriter writer;
  writer.frame(frame);
  write('s', writer.bytes());
}

void FlightLog::update(const PilotInput& input, const PilotAnswer& answer) {
  LogWriter writer;
  writer.input(input);
  writer.answer(answer);
  write('u', writer.bytes());
}

ReplayResult replayFlight(const std::string& file,
                          const std::function<void(const PilotInput&, const PilotAnswer&)>& each) {
  LogFile log(file);
  try {
    return Replay(log, each).run();
  } catch (const std::exception& error) {
    throw InputError(file, error.what());
  }
}

}  // namespace grid_path_planner::avoidance
