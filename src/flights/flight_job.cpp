#include "grid_path_planner/flights/flight_job.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>

#include "flights/flight.h"
#include "flights/flight_plan.h"
#include "flights/report/flight_pictures.h"
#include "flights/report/flight_report.h"
#include "grid_path_planner/base/files.h"
#include "study/report/table.h"
#include "study/run_folder.h"
#include "study/task_loop.h"

namespace grid_path_planner::flights {

using base::InputError, base::StopToken;
using study::forEachLine, study::RunFolder, study::StudyFailure, study::StudyOutcome,
    study::StudyTarget, study::TaskEnd, study::WorkerGroup;

namespace {

// Reads a world when the first flight is on it, and keeps it until another one is.
class FlightWorker {
 public:
  explicit FlightWorker(const FlightPlan& plan) : plan_(plan) {}

  std::string lineOfUnit(std::size_t number) {
    const FlightUnit& unit = plan_.units()[number];
    if (!setup_ || setup_->worldNumber() != unit.world) setup_.emplace(plan_.study(), unit.world);
    return lineOf(fly(*setup_, unit.variant, unit.seed)) + '\n';
  }

 private:
  const FlightPlan& plan_;
  std::optional<FlightSetup> setup_;
};

// Records by the number of their unit.
class FlownUnits {
 public:
  explicit FlownUnits(const FlightPlan& plan) {
    for (std::size_t i = 0; i < plan.units().size(); ++i) {
      const FlightUnit& unit = plan.units()[i];
      numbers_[{unit.variant, unit.world, unit.seed}] = i;
    }
  }

  void add(const std::string& line) {
    const FlightRecord record = recordFromLine(line);
    const auto number = numbers_.find({record.variant, record.world, record.seed});
    if (number == numbers_.end()) throw InputError("is no flight of this study");
    flown_[number->second] = record;
  }
  bool has(std::size_t unit) const { return flown_.count(unit) > 0; }
  std::size_t size() const { return flown_.size(); }
  std::vector<FlightRecord> inOrder() const {
    std::vector<FlightRecord> records;
    for (const auto& each : flown_) records.push_back(each.second);
    return records;
  }

 private:
  std::map<std::tuple<std::size_t, std::size_t, int>, std::size_t> numbers_;
  std::map<std::size_t, FlightRecord> flown_;
};

void addEarlier(const RunFolder& folder, FlownUnits& flown) {
  for (std::size_t i = 0; i < folder.lines().size(); ++i) {
    try {
      flown.add(folder.lines()[i]);
    } catch (const InputError& error) {
      throw InputError(folder.placeOf(i), error.what());
    }
  }
}

// The folder is made where there is none.
std::string stemIn(const std::string& folder, std::string name) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder, "cannot be made a folder: " + error.message());
  std::replace(name.begin(), name.end(), '/', '_');
  return folder + '/' + name;
}

std::string outcomeText(const FlightRecord& flight) {
  return std::string(base::choiceName(flight.end)) + " after " +
         study::shownNumber(flight.time_s, 4) + " s and " + study::shownNumber(flight.length_m, 4) +
         " m: " + flight.sentence;
}

// What the pilot says, with every change of its status and every two seconds.
class Diary {
 public:
  void note(const avoidance::PilotInput& input, const avoidance::PilotAnswer& answer) {
    constexpr double kEvery = 2.0;  // s
    if (answer.status == status_ && input.time < next_) return;
    status_ = answer.status;
    next_ = input.time + kEvery;
    char place[96];
    std::snprintf(place, sizeof place, "%7.2f s (%.2f, %.2f, %.2f) yaw %.2f %s: ", input.time,
                  input.pose->position.x(), input.pose->position.y(), input.pose->position.z(),
                  input.pose->yaw, toString(answer.status));
    text_ += place + answer.sentence + '\n';
  }
  const std::string& text() const { return text_; }

 private:
  avoidance::PilotStatus status_ = avoidance::PilotStatus::IDLE;
  double next_ = 0.0;  // s
  std::string text_;
};

}  // namespace

FlightJob::FlightJob(const std::string& file)
    : plan_(std::make_unique<FlightPlan>(readFlightFile(file))) {}

FlightJob::~FlightJob() = default;

std::size_t FlightJob::units() const {
  return plan_->units().size();
}

std::function<std::string(std::size_t)> FlightJob::work() const {
  const auto worker = std::make_shared<FlightWorker>(*plan_);
  return [worker](std::size_t unit) { return worker->lineOfUnit(unit); };
}

StudyOutcome FlightJob::run(const StudyTarget& target, WorkerGroup& workers, const StopToken& stop,
                            const std::function<void(std::size_t)>& progress) const {
  RunFolder folder(target.folder, "flights", plan_->fingerprint());
  FlownUnits flown(*plan_);
  addEarlier(folder, flown);
  StudyOutcome outcome;
  outcome.resumed = flown.size();
  std::vector<std::size_t> waiting;
  for (std::size_t unit = 0; unit < units(); ++unit)
    if (!flown.has(unit)) waiting.push_back(unit);
  std::size_t done = outcome.resumed;
  outcome.interrupted = runTasks(waiting, workers, stop, [&](const TaskEnd& end) {
    if (end.failed) {
      outcome.failures.push_back({plan_->nameOf(plan_->units()[end.task]), end.text});
    } else {
      folder.add(end.text);
      forEachLine(end.text, [&flown](const std::string& line) { flown.add(line); });
    }
    progress(++done);
  });
  outcome.runs = flown.size();
  writeFlightReport(FlightData(*plan_, flown.inOrder()), outcome.failures, units() - flown.size(),
                    target);
  return outcome;
}

FlownAgain FlightJob::flyOne(const std::string& name, const std::string& folder) const {
  const FlightUnit unit = plan_->unitOf(name);
  const FlightStudy& study = plan_->study();
  FlownAgain result;
  result.name = plan_->nameOf(unit);
  const std::string stem = stemIn(folder, result.name);
  if (study.variants[unit.variant].program.empty()) result.log = stem + ".log";
  result.picture = stem + ".svg";
  const FlightSetup setup(study, unit.world);
  Diary diary;
  const FlightRecord flight =
      fly(setup, unit.variant, unit.seed, result.log,
          [&diary](const auto& input, const auto& answer) { diary.note(input, answer); });
  base::writeFileAtomically(stem + ".txt", diary.text());
  result.outcome = outcomeText(flight);
  result.came_home = flight.success();
  WorldOutlines outlines(study);
  base::writeFileAtomically(
      result.picture, standalonePicture(flightsPicture(study, outlines.of(unit.world), {&flight},
                                                       result.name + ", " + result.outcome)));
  base::writeFileAtomically(stem + ".json", lineOf(flight) + '\n');
  return result;
}

}  // namespace grid_path_planner::flights
