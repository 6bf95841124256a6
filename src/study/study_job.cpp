#include "grid_path_planner/study/study_job.h"

#include <ctime>

#include "grid_path_planner/base/files.h"
#include "study/report/report.h"
#include "study/report/results_page.h"
#include "study/study_runner.h"
#include "study/study_worker.h"

namespace grid_path_planner::study {

using base::StopToken, base::withoutExtension, base::writeFileAtomically;

namespace {

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

// The name under which a picture is linked; "" where it is empty.
std::string writePicture(const std::string& page, const std::string& what, const std::string& svg) {
  if (svg.empty()) return "";
  const std::string file = withoutExtension(page) + '_' + what + ".svg";
  writeFileAtomically(file, svg);
  return file.substr(file.rfind('/') + 1);
}

void writeResults(const StudyData& data, const std::vector<Finding>& findings,
                  const StudyTarget& target) {
  const std::string times = writePicture(target.results, "times", timesPicture(data));
  const std::string paths = writePicture(target.results, "paths", pathsPicture(data));
  writeFileAtomically(
      target.results,
      resultsPage(data, findings, {target.command, target.commit, today()}, times, paths));
}

void writeReport(const StudyPlan& plan, const StudyFolder& folder, const StudyResult& result,
                 const StudyTarget& target) {
  const StudyData data(plan, result.runs);
  const std::vector<Finding> findings = findingsOf(data);
  writeFileAtomically(folder.file("runs.csv"), csvOf(runsTable(data)));
  for (const Finding& finding : findings)
    writeFileAtomically(folder.file(finding.table.name + ".csv"), csvOf(finding.table));
  writeFileAtomically(folder.file("study.json"), jsonReport(data, findings, result.failures));
  writeFileAtomically(folder.file("report.html"),
                      reportHtml(data, findings, result.failures, target.command));
  const bool complete = result.failures.empty() && !result.interrupted;
  if (!target.results.empty() && complete) writeResults(data, findings, target);
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

StudyOutcome StudyJob::run(const StudyTarget& target, WorkerGroup& workers, const StopToken& stop,
                           const std::function<void(std::size_t)>& progress) const {
  StudyFolder files(target.folder, plan_->fingerprint());
  const StudyResult result = runStudy(
      *plan_, files, workers, stop, [&progress](std::size_t done, std::size_t) { progress(done); });
  writeReport(*plan_, files, result, target);
  return {result.runs.size(), result.resumed, result.failures, result.interrupted};
}

}  // namespace grid_path_planner::study
