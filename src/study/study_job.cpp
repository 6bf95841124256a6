#include "grid_path_planner/study/study_job.h"

#include "grid_path_planner/base/files.h"
#include "study/report/report.h"
#include "study/study_runner.h"
#include "study/study_worker.h"

namespace grid_path_planner::study {

using base::StopToken, base::writeFileAtomically;

namespace {

void writeReport(const StudyPlan& plan, const StudyFolder& folder, const StudyResult& result,
                 const std::string& command) {
  const StudyData data(plan, result.runs);
  const std::vector<Finding> findings = findingsOf(data);
  writeFileAtomically(folder.file("runs.csv"), csvOf(runsTable(data)));
  for (const Finding& finding : findings)
    writeFileAtomically(folder.file(finding.table.name + ".csv"), csvOf(finding.table));
  writeFileAtomically(folder.file("study.json"), jsonReport(data, findings, result.failures));
  writeFileAtomically(folder.file("report.html"),
                      reportHtml(data, findings, result.failures, command));
}

}  // namespace

StudyJob::StudyJob(const std::string& study_file, const MapReader& read_map)
    : plan_(std::make_unique<StudyPlan>(readStudyFile(study_file), read_map)) {}

StudyJob::~StudyJob() = default;

std::size_t StudyJob::units() const {
  return plan_->units().size();
}

std::function<std::string(std::size_t)> StudyJob::work() const {
  const auto worker = std::make_shared<StudyWorker>(*plan_);
  return
      [plan = plan_.get(), worker](std::size_t unit) { return linesOfUnit(*worker, *plan, unit); };
}

StudyOutcome StudyJob::run(const std::string& folder, const std::string& command,
                           WorkerGroup& workers, const StopToken& stop,
                           const std::function<void(std::size_t)>& progress) const {
  StudyFolder files(folder, plan_->fingerprint());
  const StudyResult result = runStudy(
      *plan_, files, workers, stop, [&progress](std::size_t done, std::size_t) { progress(done); });
  writeReport(*plan_, files, result, command);
  return {result.runs.size(), result.resumed, result.failures, result.interrupted};
}

}  // namespace grid_path_planner::study
