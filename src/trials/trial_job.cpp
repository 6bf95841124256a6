#include "trials/trial_job.h"

#include <map>
#include <optional>
#include <tuple>

#include "grid_path_planner/base/files.h"
#include "study/run_folder.h"
#include "study/task_loop.h"
#include "trials/marker_errors.h"
#include "trials/report/trial_report.h"
#include "trials/sensor_tape.h"
#include "trials/track_file.h"
#include "trials/trial_plan.h"
#include "trials/trial_record.h"
#include "trials/trial_run.h"

namespace grid_path_planner::trials {

using base::InputError, base::StopToken;
using study::forEachLine, study::RunFolder, study::StudyOutcome, study::StudyTarget, study::TaskEnd,
    study::WorkerGroup;

namespace {

constexpr std::size_t kLargestTable = std::size_t{1} << 30;
constexpr char kTable[] = "/marker_poses.jsonl";

// Reads the world when the first unit needs it, and the table of marker poses when the first run does.
class TrialWorker {
 public:
  TrialWorker(const TrialPlan& plan, std::string folder)
      : plan_(plan), folder_(std::move(folder)) {}

  std::string linesOf(std::size_t number) {
    if (!world_)
      world_.emplace(
          simulation::readWorld(plan_.study().world, base::ReadLimits::ofProcessorTime()));
    const TrialUnit& unit = plan_.units()[number];
    return unit.renders ? render(unit) : run(unit);
  }

 private:
  std::string render(const TrialUnit& unit) {
    if (!renderer_) renderer_.emplace(plan_.study(), *world_);
    std::string lines;
    for (int i = 0; i < unit.frames; ++i)
      lines += lineOf(renderer_->look(unit.first_frame + i, unit.water)) + '\n';
    return lines;
  }

  std::string run(const TrialUnit& unit) {
    const TrialStudy& study = plan_.study();
    if (!errors_) readTable();
    const MarkerSource source = unit.seed == kShownSeed ? MarkerSource::SHOWN : MarkerSource::DRAWN;
    const SensorTape tape = recorded(study, *world_, unit.set, unit.seed, *errors_, source);
    const bool kept = unit.seed == study.first_seed;
    RunRecord record{unit.set, unit.seed, {}};
    for (const TrialRow& row : trialRows()) {
      RunTracks tracks;
      record.rows.push_back(played(study, row, tape, kept ? &tracks : nullptr));
      if (kept)
        writeTrack(folder_, trackNameOf(study.sets[unit.set].name, row.name), tracks.estimate);
      if (kept && &row == &trialRows().front())
        writeTrack(folder_, trackNameOf(study.sets[unit.set].name, kTruth), tracks.truth);
    }
    return lineOf(record) + '\n';
  }

  void readTable() {
    std::vector<SeenFrame> frames;
    forEachLine(base::readWholeFile(folder_ + kTable, kLargestTable),
                [&](const std::string& line) { frames.push_back(frameFromLine(line)); });
    errors_.emplace(plan_.study(), frames);
  }

  const TrialPlan& plan_;
  std::string folder_;
  std::optional<simulation::World> world_;
  std::optional<ViewRenderer> renderer_;
  std::optional<MarkerErrors> errors_;
};

}  // namespace

// Lines by the number of their unit.
class DoneUnits {
 public:
  DoneUnits(const TrialPlan& plan, RunFolder& folder) : plan_(plan), folder_(folder) {
    for (std::size_t i = 0; i < plan.units().size(); ++i) {
      const TrialUnit& unit = plan.units()[i];
      if (!unit.renders) numbers_[{false, false, unit.set, unit.seed}] = i;
      for (int frame = 0; frame < unit.frames; ++frame)
        numbers_[{true, unit.water == Water::TURBID, 0, unit.first_frame + frame}] = i;
    }
    for (std::size_t i = 0; i < folder.lines().size(); ++i) {
      try {
        add(folder.lines()[i]);
      } catch (const InputError& error) {
        throw InputError(folder.placeOf(i), error.what());
      }
    }
  }

  void keep(const std::string& lines) {
    folder_.add(lines);
    forEachLine(lines, [this](const std::string& line) { add(line); });
  }

  // A unit of which a line was cut off is done again.
  bool has(std::size_t unit) const {
    const auto lines = lines_.find(unit);
    const auto wanted = static_cast<std::size_t>(std::max(1, plan_.units()[unit].frames));
    return lines != lines_.end() && lines->second.size() == wanted;
  }
  std::size_t all() const { return plan_.units().size(); }
  std::size_t count() const { return all() - missing(0, all()).size(); }
  std::vector<std::size_t> missing(std::size_t from, std::size_t to) const {
    std::vector<std::size_t> units;
    for (std::size_t unit = from; unit < to; ++unit)
      if (!has(unit)) units.push_back(unit);
    return units;
  }

  // In the order of the units.
  void forEach(const std::function<void(const std::string&)>& use) const {
    for (const auto& unit : lines_)
      for (const auto& line : unit.second) use(line.second);
  }

 private:
  using Key = std::tuple<bool, bool, std::size_t, int>;

  void add(const std::string& line) {
    Key key;
    if (isFrameLine(line)) {
      const SeenFrame frame = frameFromLine(line);
      key = {true, frame.water == Water::TURBID, 0, frame.frame};
    } else {
      const RunRecord run = runFromLine(line);
      key = {false, false, run.set, run.seed};
    }
    const auto number = numbers_.find(key);
    if (number == numbers_.end()) throw InputError("is no line of this study");
    lines_[number->second][std::get<3>(key)] = line;
  }

  const TrialPlan& plan_;
  RunFolder& folder_;
  std::map<Key, std::size_t> numbers_;
  std::map<std::size_t, std::map<int, std::string>> lines_;
};

namespace {

// The poses in turbid water, which runs draw from.
void writeTable(const DoneUnits& done, const std::string& folder) {
  std::string table;
  done.forEach([&table](const std::string& line) {
    if (isFrameLine(line) && frameFromLine(line).water == Water::TURBID) table += line + '\n';
  });
  base::writeFileAtomically(folder + kTable, table);
}

TrialData dataOf(const TrialStudy& study, const DoneUnits& done) {
  TrialData data{study, {}, {}, done.missing(0, done.all()).size()};
  done.forEach([&data](const std::string& line) {
    if (isFrameLine(line))
      data.frames.push_back(frameFromLine(line));
    else
      data.runs.push_back(runFromLine(line));
  });
  return data;
}

}  // namespace

TrialJob::TrialJob(const std::string& file)
    : plan_(std::make_unique<TrialPlan>(readTrialFile(file))) {}

TrialJob::~TrialJob() = default;

std::size_t TrialJob::units() const {
  return plan_->units().size();
}

std::function<std::string(std::size_t)> TrialJob::work(const std::string& folder) const {
  const auto worker = std::make_shared<TrialWorker>(*plan_, folder);
  return [worker](std::size_t unit) { return worker->linesOf(unit); };
}

// Whether all of them were done.
bool TrialJob::runStage(const std::vector<std::size_t>& waiting, WorkerGroup& workers,
                        const StopToken& stop, const std::function<void(std::size_t)>& progress,
                        DoneUnits& done, StudyOutcome& outcome) const {
  const std::size_t before = outcome.failures.size();
  outcome.interrupted = runTasks(waiting, workers, stop, [&](const TaskEnd& end) {
    if (end.failed)
      outcome.failures.push_back({plan_->nameOf(plan_->units()[end.task]), end.text});
    else
      done.keep(end.text);
    progress(done.count());
  });
  return !outcome.interrupted && outcome.failures.size() == before;
}

StudyOutcome TrialJob::run(const StudyTarget& target, WorkerGroup& workers, const StopToken& stop,
                           const std::function<void(std::size_t)>& progress) const {
  RunFolder folder(target.folder, "trials", plan_->fingerprint());
  DoneUnits done(*plan_, folder);
  StudyOutcome outcome;
  outcome.resumed = done.count();
  const std::size_t rendering = plan_->renderingUnits();
  if (runStage(done.missing(0, rendering), workers, stop, progress, done, outcome)) {
    writeTable(done, target.folder);
    runStage(done.missing(rendering, units()), workers, stop, progress, done, outcome);
  }
  outcome.runs = done.count();
  const TrialData data = dataOf(plan_->study(), done);
  if (data.canBeReported()) writeTrialReport(data, target);
  return outcome;
}

}  // namespace grid_path_planner::trials
