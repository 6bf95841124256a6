#include "trials/trial_job.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "grid_path_planner/study/process_pool.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"
#include "trials/trial_plan.h"

namespace grid_path_planner::trials {
namespace {

using base::StopSource;
using study::ProcessPool, study::StudyOutcome;
using test::contains, test::contentOf;

std::string absolute(const std::string& name) {
  return std::filesystem::absolute(name).string();
}

// Seven small images in either water, one error set, four seeds.
class SmallTrial : public testing::Test {
 protected:
  std::string write(const std::string& world = absolute("worlds/panel_site.sdf")) const {
    return folder.write(
        "trial.yaml",
        "title: Short\nworld: " + world + "\nlayout: layout.yaml" +
            "\npanel: [4.05, -0.55, 2.9, 0.42]\ndrive: {seconds: 12}\nseeds: 4\nsettle: 2\n"
            "fault: [4, 8]\ncamera: {rate: 0.5, width: 320, height: 240}\n"
            "sensors: {imu_enabled: true, dvl_enabled: true, pressure_enabled: true, usbl_enabled: "
            "true}\n"
            "error_sets: [{name: nominal}]\n");
  }
  // Ends when `last` units are done.
  StudyOutcome run(const TrialJob& job, std::size_t last) const {
    StopSource stop;
    ProcessPool pool(1, job.work(folder.path("out")));
    return job.run({folder.path("out"), "a test", folder.path("page.md"), ""}, pool, stop.token(),
                   [&](std::size_t done) {
                     if (done == last) stop.cancel();
                   });
  }
  std::uint64_t fingerprint(const std::string& world) const {
    return TrialPlan(readTrialFile(write(world))).fingerprint();
  }

  const test::TemporaryFolder folder;
  const std::string layout = folder.write("layout.yaml", contentOf("config/panel_markers.yaml"));
};

// The page of 50 seeds was written over by that of two, and nothing in it said so.
TEST_F(SmallTrial, AnInterruptedOneLeavesThePageOfResultsAsItIs) {
  const TrialJob job(write());
  ASSERT_EQ(job.units(), 7u) << "two of images, the run with their poses, four seeds";
  const std::string page = folder.write("page.md", "before");
  const StudyOutcome two_seeds = run(job, 5);
  EXPECT_TRUE(two_seeds.interrupted);
  EXPECT_EQ(two_seeds.runs, 5u);
  EXPECT_EQ(contentOf(page), "before");
  EXPECT_TRUE(contains(contentOf(folder.path("out/summary.yaml")), "missing: 2\n"));
  EXPECT_FALSE(run(job, 0).interrupted);
  EXPECT_TRUE(contains(contentOf(page), "# Results: Short"));
  EXPECT_TRUE(contains(contentOf(folder.path("out/summary.yaml")), "missing: 0\n"));
}

// Whose SDF was as before, and a mesh that it names another one.
TEST_F(SmallTrial, AnotherMeshOrLayoutIsAnotherTrial) {
  const auto mesh = [this](const char* height) {
    folder.write("panel.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 ") + height + "\nf 1 2 3\n");
  };
  folder.write("site.sdf",
               "<sdf version='1.6'><world name='site'><model name='panel'><static>1</static>"
               "<link name='l'><collision name='c'><geometry><mesh><uri>panel.obj</uri></mesh>"
               "</geometry></collision></link></model></world></sdf>");
  mesh("0");
  const std::uint64_t before = fingerprint("site.sdf");
  EXPECT_EQ(fingerprint("site.sdf"), before);
  mesh("1");
  const std::uint64_t with_mesh = fingerprint("site.sdf");
  EXPECT_NE(with_mesh, before);
  folder.write("layout.yaml", contentOf(layout) + "# another\n");
  EXPECT_NE(fingerprint("site.sdf"), with_mesh);
}

}  // namespace
}  // namespace grid_path_planner::trials
