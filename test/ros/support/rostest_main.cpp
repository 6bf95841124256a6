// The main of every rostest: runs the tests of one file, <first argument>_rostest.cpp, while callbacks run in two threads
// of their own.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <iostream>
#include <string>

namespace {

// gtest's filter for the tests of a file; empty where it has none.
std::string filterFor(const std::string& name) {
  const std::string file = "/" + name + "_rostest.cpp";
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      const std::string path = test.file();
      if (path.size() >= file.size() &&
          path.compare(path.size() - file.size(), file.size(), file) == 0) {
        filter += std::string(suite.name()) + "." + test.name() + ":";
      }
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rostest");
  const std::string filter = argc == 2 ? filterFor(argv[1]) : "";
  if (filter.empty()) {
    std::cerr << "the argument has to be X, for the tests of X_rostest.cpp of this program"
              << std::endl;
    return 2;
  }
  if (testing::GTEST_FLAG(filter) == "*") {
    testing::GTEST_FLAG(filter) = filter;
  }
  ros::NodeHandle keeps_ros_running;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
