#include "study/confidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "study/report/table.h"

namespace grid_path_planner::study {
namespace {

TEST(Confidence, OfAMeanIsStudentsInterval) {
  // Mean 3, standard error sqrt(2.5 / 5); t(0.975, 4) = 2.776445 (any table of Student's t).
  const Interval mean = meanDifference({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.high - 3.0, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(3.0 - mean.low, 2.776445 * std::sqrt(0.5), 1e-5);
}

// t = 3 / sqrt(2.5 / 5) = 4.2426 with 4 degrees of freedom: p = 0.01324 (R: t.test(1:5)).
TEST(PairedTest, IsStudents) {
  EXPECT_NEAR(pairedP({1, 2, 3, 4, 5}), 0.01324, 1e-5);
  EXPECT_NEAR(pairedP({-1, -2, -3, -4, -5}), 0.01324, 1e-5) << "two-sided";
  EXPECT_EQ(pairedP({2.0}), 1.0) << "one alone says nothing";
  EXPECT_EQ(pairedP({0.0, 0.0}), 1.0);
  EXPECT_EQ(pairedP({1.0, 1.0}), 0.0);
}

// R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm").
TEST(HolmsCorrection, OfFourTests) {
  const std::vector<double> corrected = holmCorrected({0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(corrected[i], expected[i], 1e-12) << i;
  EXPECT_TRUE(holmCorrected({}).empty());
  EXPECT_EQ(holmCorrected({0.7, 0.9}).front(), 1.0) << "never above 1";
}

// A corrected value below the level is a rejection by the procedure as Holm wrote it: step through
// the sorted values while p < level / (tests left), and stop at the first that is not.
TEST(HolmsCorrectionLaw, RejectsWhatTheStepDownProcedureRejects) {
  std::mt19937 random(1979);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> values(1 + random() % 9);
    for (double& value : values) value = std::pow(static_cast<double>(random() % 10007) / 1e4, 3);
    const std::vector<double> corrected = holmCorrected(values);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    std::size_t rejected = 0;
    while (rejected < sorted.size() &&
           sorted[rejected] * static_cast<double>(sorted.size() - rejected) < 0.05)
      ++rejected;
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(corrected[i]<0.05, rejected> 0 && values[i] <= sorted[rejected - 1])
          << "trial " << trial << ", p " << values[i];
  }
}

TEST(Confidence, OfARatioIsThatOfItsLogarithm) {
  const Interval ratio = meanRatio({2.0, 8.0});
  EXPECT_NEAR(ratio.value, 4.0, 1e-12);
  EXPECT_NEAR(ratio.value / ratio.low, ratio.high / ratio.value, 1e-9);
  EXPECT_FALSE(differs(ratio)) << "two ratios so far apart say nothing";
  EXPECT_TRUE(differs(meanRatio({2.0, 2.1, 1.9, 2.05})));
  EXPECT_FALSE(differs(meanRatio({3.0}))) << "one alone says nothing of its spread";
}

TEST(Confidence, OfAShareIsWilsons) {
  // Wilson (1927) for 8 of 10: 0.4902 to 0.9433.
  const Interval share_of_ten = share(8, 10, 10);
  EXPECT_NEAR(share_of_ten.low, 0.4902, 1e-4);
  EXPECT_NEAR(share_of_ten.high, 0.9433, 1e-4);
  EXPECT_EQ(share(0, 10, 10).low, 0.0);
  EXPECT_GT(share(0, 10, 10).high, 0.0);
  EXPECT_LT(share(80, 100, 100).high - share(80, 100, 100).low,
            share(80, 100, 10).high - share(80, 100, 10).low)
      << "fewer samples, less certainty";
}

// The law that gives the interval its name.
TEST(Confidence, HoldsTheTrueRatioInAbout95Of100Samples) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(std::log(1.5), 0.4);
  int held = 0;
  constexpr int kSamples = 2000;
  for (int sample = 0; sample < kSamples; ++sample) {
    std::vector<double> ratios;
    for (int i = 0; i < 10; ++i) ratios.push_back(std::exp(noise(random)));
    const Interval found = meanRatio(ratios);
    held += found.low <= 1.5 && 1.5 <= found.high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(kSamples), 0.95, 0.02);
}

TEST(Confidence, QuantilesLieBetweenTheValues) {
  EXPECT_DOUBLE_EQ(quantileOf({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantileOf({7}, 0.25), 7.0);
  EXPECT_DOUBLE_EQ(quantileOf({1, 2, 3, 4, 5}, 0.25), 2.0);
}

TEST(ShownNumber, IsForPeople) {
  EXPECT_EQ(shownNumber(0.012345), "0.0123");
  EXPECT_EQ(shownNumber(4.5678), "4.57");
  EXPECT_EQ(shownNumber(123.4), "123");
  EXPECT_EQ(shownNumber(45678.9), "45,679");
  EXPECT_EQ(shownNumber(-45678.9), "-45,679");
  EXPECT_EQ(shownNumber(630), "630");
  EXPECT_EQ(shownNumber(0), "0");
  EXPECT_EQ(shownNumber(1e-7), "1e-07");
  EXPECT_EQ(shownNumber(std::numeric_limits<double>::infinity()), "∞");
}

// Equal spreads of two values each leave two degrees of freedom, for which Student's distribution has a
// closed form: p = 1 - t / sqrt(2 + t^2).
TEST(Welch, IsTheClosedFormAtTwoDegreesOfFreedom) {
  const double t = 5.0 / std::sqrt(2.0);
  EXPECT_NEAR(welchP({0.0, 2.0}, {5.0, 7.0}), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
  EXPECT_EQ(welchP({3.0, 3.0}, {3.0, 3.0}), 1.0);
  EXPECT_EQ(welchP({3.0, 3.0}, {4.0, 4.0}), 0.0);
}

// Of 20 flights each: 17 against 19 says nothing, 4 against 18 does.
TEST(Fisher, IsTheSumOfTheTablesThatAreNoLikelier) {
  EXPECT_NEAR(fisherP(17, 20, 19, 20), 0.60, 0.01);
  EXPECT_NEAR(fisherP(4, 20, 18, 20), 0.00002, 0.000005);
  EXPECT_NEAR(fisherP(3, 4, 1, 4), 34.0 / 70.0, 1e-12) << "the lady who tastes tea, two-sided";
  EXPECT_EQ(fisherP(0, 5, 0, 7), 1.0);
  EXPECT_NEAR(fisherP(19, 20, 17, 20), fisherP(17, 20, 19, 20), 1e-12);
}

}  // namespace
}  // namespace grid_path_planner::study
