#include "grid_path_planner/study/scenario_file.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/text_variants.h"

namespace grid_path_planner::study {
namespace {

// Of lines with blanks at their end the optimum had no decimals, and any cost within half a cell was right.
TEST(ScenarioFile, WhatEditorsLeaveIsRead) {
  const test::TemporaryFolder folder;
  for (const auto& [name, text] :
       test::variantsOf("version 1\n0 a.map 49 50 1 2 3 4 2.82842712\n\n")) {
    const std::vector<ScenarioQuery> queries = readScenarioFile(folder.write("a.scen", text));
    ASSERT_EQ(queries.size(), 1u) << name;
    EXPECT_EQ(queries[0].map, "a.map") << name;
    EXPECT_EQ(queries[0].goal, (grid::Cell{3, 4})) << name;
    EXPECT_EQ(queries[0].optimum, 2.82842712) << name;
    EXPECT_DOUBLE_EQ(queries[0].rounding, 0.5e-8) << name;
  }
}

}  // namespace
}  // namespace grid_path_planner::study
