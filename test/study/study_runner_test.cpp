#include "study/study_runner.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "small_study.h"
#include "study/report/report.h"
#include "support/error_text.h"
#include "support/file_size_limit.h"

namespace grid_path_planner::study {

using base::Status;
using base::StopSource;
using base::StopToken;

namespace {

using test::contains;
using test::errorText;
using test::runWith;
using test::smallStudy;
using test::TemporaryFolder;

std::string withoutTimes(StudyRun run) {
  run.times_ms = {0.0};
  run.preparation_ms = 0.0;
  return lineOf(run);
}

TEST(StudyRunner, AnyNumberOfWorkersFindsTheSame) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  StudyFolder one(files.path("one"), plan.fingerprint()),
      three(files.path("three"), plan.fingerprint());
  const StudyResult alone = runWith(plan, one, 1), together = runWith(plan, three, 3);
  ASSERT_EQ(alone.runs.size(), 2u * 2u * 3u * 3u);
  ASSERT_EQ(together.runs.size(), alone.runs.size());
  for (std::size_t i = 0; i < alone.runs.size(); ++i)
    EXPECT_EQ(withoutTimes(alone.runs[i]), withoutTimes(together.runs[i]));
  EXPECT_TRUE(alone.failures.empty());
}

TEST(StudyRunner, MeasuresWhatWasFound) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const StudyResult result = runWith(plan, folder, 1);
  std::size_t unreachable = 0;
  for (const StudyRun& run : result.runs) {
    EXPECT_EQ(run.times_ms.size(), 2u) << "one time a repeat";
    unreachable += run.status == Status::UNREACHABLE ? 1 : 0;
    if (run.status != Status::FOUND) continue;
    EXPECT_EQ(run.cost, run.optimum) << "all three are optimal here";
    EXPECT_GT(run.length_m, 0.0);
    EXPECT_GT(run.expanded, 0u);
    EXPECT_GT(run.cells, 0u);
    EXPECT_GE(run.path_xy.size(), 4u);
    EXPECT_EQ(run.occupied_m, 0.0);
  }
  EXPECT_GE(unreachable, 6u) << "the pocket in the corner, at every setting";
}

TEST(StudyRunner, AnInterruptedStudyGoesOnWhereItWas) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  std::string whole;
  {
    StudyFolder folder(files.path("out"), plan.fingerprint());
    runWith(plan, folder, 1);
    whole = test::contentOf(folder.file("runs.jsonl"));
  }
  // Cut inside the line of a run, in the middle of a unit.
  const std::string cut = whole.substr(0, whole.size() * 2 / 5);
  files.write("out/runs.jsonl", cut);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  EXPECT_FALSE(folder.runs().empty());
  const StudyResult result = runWith(plan, folder, 1);
  EXPECT_GT(result.resumed, 0u);
  EXPECT_LT(result.resumed, plan.units().size());
  EXPECT_EQ(result.runs.size(), 36u);
  EXPECT_TRUE(result.failures.empty());
}

TEST(StudyRunner, ResumingWhatIsDoneRunsNothing) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  std::vector<StudyRun> before;
  {
    StudyFolder folder(files.path("out"), plan.fingerprint());
    before = runWith(plan, folder, 1).runs;
  }
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const StudyResult result = runWith(plan, folder, 1);
  EXPECT_EQ(result.resumed, plan.units().size());
  ASSERT_EQ(result.runs.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(lineOf(result.runs[i]), lineOf(before[i])) << "times included";
}

TEST(StudyRunner, StopsWhenAsked) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const auto worker = std::make_shared<StudyWorker>(plan);
  ProcessPool pool(1, [&](std::size_t task) { return linesOfUnit(*worker, plan, task); });
  StopSource stop;
  const StudyResult result = runStudy(plan, folder, pool, stop.token(),
                                      [&stop](std::size_t, std::size_t) { stop.cancel(); });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.runs.size(), 3u) << "the one unit that had begun";
}

TEST(StudyRunner, ALostWorkersUnitIsNamedAndTheRestCompletes) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  {
    StudyFolder folder(files.path("out"), plan.fingerprint());
    const auto worker = std::make_shared<StudyWorker>(plan);
    ProcessPool pool(2, [&](std::size_t task) {
      if (task == 4) ::kill(::getpid(), SIGKILL);
      return linesOfUnit(*worker, plan, task);
    });
    const StudyResult result =
        runStudy(plan, folder, pool, StopToken(), [](std::size_t, std::size_t) {});
    ASSERT_EQ(result.failures.size(), 1u);
    EXPECT_EQ(result.failures[0].unit,
              "site, kernel 1 conservative, weights 1/50/100, (0, 5) to (6, 0)");
    EXPECT_EQ(result.runs.size(), 33u);
  }
  StudyFolder folder(files.path("out"), plan.fingerprint());
  const StudyResult again = runWith(plan, folder, 1);
  EXPECT_EQ(again.resumed, plan.units().size() - 1);
  EXPECT_EQ(again.runs.size(), 36u);
}

TEST(StudyFolder, IsOneStudysAlone) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  const StudyFolder folder(files.path("out"), plan.fingerprint());
  EXPECT_TRUE(contains(errorText([&] { StudyFolder(files.path("out"), plan.fingerprint()); }),
                       "out: another study is writing into this folder"));
}

TEST(StudyFolder, RefusesRunsOfAnotherStudy) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  { StudyFolder(files.path("out"), plan.fingerprint()); }
  EXPECT_TRUE(contains(errorText([&] { StudyFolder(files.path("out"), plan.fingerprint() + 1); }),
                       "runs.jsonl: holds the runs of another study"));
}

TEST(StudyFolder, ADamagedLineIsNamed) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  std::string head;
  {
    const StudyFolder folder(files.path("out"), plan.fingerprint());
    head = test::contentOf(folder.file("runs.jsonl"));
  }
  files.write("out/runs.jsonl", head + "{\"setting\": 0}\n");
  EXPECT_TRUE(contains(errorText([&] { StudyFolder(files.path("out"), plan.fingerprint()); }),
                       "runs.jsonl:2: is no run of a study"));
}

TEST(StudyFolder, AFullDiskIsToldAndLosesNothing) {
  const TemporaryFolder files;
  const StudyPlan plan = smallStudy(files);
  StudyFolder folder(files.path("out"), plan.fingerprint());
  StudyWorker worker(plan);
  const std::string lines = linesOfUnit(worker, plan, 0);
  folder.add(lines);
  const std::string before = test::contentOf(folder.file("runs.jsonl"));
  EXPECT_TRUE(test::refusedOnAFullDisk(before.size() + lines.size() / 2,
                                       [&] { folder.add(linesOfUnit(worker, plan, 1)); }));
  EXPECT_EQ(test::contentOf(folder.file("runs.jsonl")), before);
}

}  // namespace
}  // namespace grid_path_planner::study
