#include "study/study_runner.h"

#include <algorithm>
#include <map>
#include <utility>

#include "study/study_worker.h"
#include "study/task_loop.h"

namespace grid_path_planner::study {

using base::StopToken;

namespace {

// Runs by unit.
class UnitRuns {
 public:
  explicit UnitRuns(const StudyPlan& plan) : plan_(plan), runs_(plan.units().size()) {
    for (std::size_t i = 0; i < plan.units().size(); ++i)
      unit_[{plan.units()[i].setting, plan.units()[i].query}] = i;
  }

  void add(const StudyRun& run) {
    const auto unit = unit_.find({run.setting, run.query});
    if (unit != unit_.end()) runs_[unit->second][run.variant] = run;
  }

  // False where a unit's lines were cut off: it is run again.
  bool done(std::size_t unit) const { return runs_[unit].size() == plan_.study().variants.size(); }

  std::vector<StudyRun> inOrder() const {
    std::vector<StudyRun> all;
    for (std::size_t unit = 0; unit < runs_.size(); ++unit)
      if (done(unit))
        for (const auto& run : runs_[unit]) all.push_back(run.second);
    return all;
  }

 private:
  const StudyPlan& plan_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> unit_;
  std::vector<std::map<std::size_t, StudyRun>> runs_;  // by variant
};

}  // namespace

std::string linesOfUnit(StudyWorker& worker, const StudyPlan& plan, std::size_t task) {
  std::string lines;
  for (const StudyRun& run : worker.run(plan.units()[task])) lines += lineOf(run) + '\n';
  return lines;
}

StudyResult runStudy(const StudyPlan& plan, StudyFolder& folder, WorkerGroup& workers,
                     const StopToken& stop,
                     const std::function<void(std::size_t, std::size_t)>& progress) {
  StudyResult result;
  UnitRuns runs(plan);
  for (const StudyRun& run : folder.runs()) runs.add(run);

  const std::size_t total = plan.units().size();
  std::vector<std::size_t> waiting;
  for (std::size_t unit = 0; unit < total; ++unit)
    if (!runs.done(unit)) waiting.push_back(unit);
  result.resumed = total - waiting.size();

  std::size_t done = result.resumed;
  result.interrupted = runTasks(waiting, workers, stop, [&](const TaskEnd& end) {
    if (end.failed) {
      result.failures.push_back({plan.nameOf(plan.units()[end.task]), end.text});
    } else {
      folder.add(end.text);
      forEachLine(end.text, [&](const std::string& line) { runs.add(runFromLine(line)); });
    }
    progress(++done, total);
  });
  result.runs = runs.inOrder();
  return result;
}

}  // namespace grid_path_planner::study
