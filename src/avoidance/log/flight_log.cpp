#include "grid_path_planner/avoidance/flight_log.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>

#include "avoidance/log/log_bytes.h"
#include "avoidance/memory/open_space.h"
#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::avoidance {

using base::InputError;
using base::OptionInfo;

namespace {

constexpr const char* kFirstLine = "grid_path_planner flight 2";
constexpr std::uint64_t kLargestRecord = std::uint64_t{1} << 30;  // bytes
constexpr std::size_t kRecordHead = 9;                            // bytes: its kind and its size
constexpr std::size_t kReadPiece = 1 << 20;                       // bytes that are taken at once

// The options one a line, "name: value", numbers so that they read back as the same.
std::string optionLines(PilotOptions options) {
  std::string lines;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo&) {
    using Value = std::decay_t<decltype(value)>;
    lines += std::string(name) + ": ";
    if constexpr (std::is_same_v<Value, bool>)
      lines += value ? "true" : "false";
    else if constexpr (std::is_enum_v<Value>)
      lines += base::choiceName(value);
    else
      lines += base::decimalText(static_cast<double>(value));
    lines += "\n";
  });
  return lines;
}

// One that an int holds too; the options' own limits are narrower.
double numberOf(const char* name, const std::string& text) {
  const double number = std::stod(text);
  if (!(std::abs(number) < 2e9))
    throw InputError(std::string("the option ") + name + " is " + text);
  return number;
}

PilotOptions optionsOf(const std::map<std::string, std::string>& lines) {
  PilotOptions options;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo&) {
    using Value = std::decay_t<decltype(value)>;
    const auto line = lines.find(name);
    if (line == lines.end()) throw InputError(std::string("the option ") + name + " is missing");
    if constexpr (std::is_same_v<Value, bool>)
      value = line->second == "true";
    else if constexpr (std::is_enum_v<Value>)
      value = base::choiceFromName<Value>(name, line->second);
    else
      value = static_cast<Value>(numberOf(name, line->second));
  });
  checkPilotOptions(options);
  return options;
}

PilotOptions readOptions(std::istream& in) {
  std::string line;
  std::map<std::string, std::string> lines;
  while (std::getline(in, line) && line != "...") {
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

// None at the end, and where the last one is cut off.
std::optional<Record> readRecord(std::istream& in) {
  Record record;
  std::uint64_t size = 0;
  if (!in.get(record.kind) || !in.read(reinterpret_cast<char*>(&size), sizeof(size)))
    return std::nullopt;
  if (size > kLargestRecord) throw InputError("a record of " + std::to_string(size) + " bytes");
  // Piece by piece: a damaged size takes no more memory than the file is long.
  while (record.bytes.size() < size) {
    const std::size_t begin = record.bytes.size();
    const std::size_t piece = std::min<std::uint64_t>(kReadPiece, size - begin);
    record.bytes.resize(begin + piece);
    if (!in.read(&record.bytes[begin], static_cast<std::streamsize>(piece))) return std::nullopt;
  }
  return record;
}

// The pilot of a log, and its answers compared.
class Replay {
 public:
  using Each = std::function<void(const PilotInput&, const PilotAnswer&)>;

  Replay(std::istream& in, const PilotOptions& options, Each each)
      : in_(in), pilot_(options), each_(std::move(each)) {
    pilot_.setMapPlan([this](const Eigen::Vector3d&, const Eigen::Vector3d&) {
      return std::exchange(plan_, std::nullopt);
    });
  }

  // A plan on the map is written before the answer that it led to.
  ReplayResult run() {
    while (const std::optional<Record> record = readRecord(in_)) use(*record);
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
      case 'h':
        return reader.number<std::uint8_t>() != 0 ? pilot_.pause() : pilot_.resume();
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

  static PilotOptions optionsIn(const std::string& text) {
    std::istringstream in(text);
    return readOptions(in);
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

  std::istream& in_;
  Pilot pilot_;
  Each each_;
  std::optional<Points> plan_;
  ReplayResult result_;
};

}  // namespace

FlightLog::FlightLog(const base::OutputFile& file, const PilotOptions& options, std::uint64_t limit)
    : out_(file), left_(limit) {
  const std::string head = std::string(kFirstLine) + "\n" + optionLines(options) + "...\n";
  const std::string problem = out_.write(head.data(), head.size());
  if (!problem.empty()) throw InputError(file.name(), "cannot be written: " + problem);
}

void FlightLog::write(char kind, const std::vector<char>& bytes) {
  const std::uint64_t size = bytes.size();
  if (full()) return;
  if (size + kRecordHead > left_) {
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
  writer.text(optionLines(options));
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

void FlightLog::pause() {
  write('h', {1});
}

void FlightLog::resume() {
  write('h', {0});
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
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line != kFirstLine)
    throw InputError(file,
                     std::string("is no flight log: its first line must be '") + kFirstLine + "'");
  try {
    const PilotOptions options = readOptions(in);
    return Replay(in, options, each).run();
  } catch (const std::exception& error) {
    throw InputError(file, error.what());
  }
}

}  // namespace grid_path_planner::avoidance
