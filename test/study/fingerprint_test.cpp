#include "study/fingerprint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::study {
namespace {

std::uint64_t printOf(const std::vector<std::string>& texts) {
  Fingerprint print;
  for (const std::string& text : texts) print.addText(text);
  return print.value();
}

std::uint64_t printOfVector(const Eigen::Vector3d& vector) {
  Fingerprint print;
  print.addMatrix(vector);
  return print.value();
}

TEST(Fingerprint, IsThatOfThePartsInTheirOrder) {
  EXPECT_EQ(printOf({"a", "b"}), printOf({"a", "b"}));
  EXPECT_NE(printOf({"a", "b"}), printOf({"b", "a"}));
  EXPECT_NE(printOf({"ab", "c"}), printOf({"a", "bc"})) << "parts run into each other";
  EXPECT_NE(printOf({""}), printOf(std::vector<std::string>()));
}

TEST(Fingerprint, CountsTheLastBitOfANumber) {
  const double next = std::nextafter(0.3, 1.0);
  EXPECT_EQ(printOfVector({0.1, 0.2, 0.3}), printOfVector({0.1, 0.2, 0.3}));
  EXPECT_NE(printOfVector({0.1, 0.2, 0.3}), printOfVector({0.1, 0.2, next}));
}

TEST(Fingerprint, CountsAFileByWhatItHoldsAndNotByItsName) {
  const test::TemporaryFolder folder;
  const auto printOfFile = [&folder](const std::string& name, const std::string& content) {
    Fingerprint print;
    print.addFile(folder.write(name, content));
    return print.value();
  };
  const std::string large(3 << 20, 'x');
  EXPECT_EQ(printOfFile("a", large), printOfFile("b", large));
  EXPECT_NE(printOfFile("a", large), printOfFile("a", large + 'x'));
  EXPECT_NE(printOfFile("a", ""), printOfFile("a", "x"));
  EXPECT_TRUE(test::contains(
      test::errorText([&folder] { Fingerprint().addFile(folder.path("gone")); }), "gone"));
}

}  // namespace
}  // namespace grid_path_planner::study
