#include "vision/marker_detection.h"

#include <gtest/gtest.h>

#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace grid_path_planner::vision {
namespace {

// A tag drawn by OpenCV in an image of 400 x 300 pixels, its corners where `corners` are, with a white margin.
cv::Mat imageOf(int id, const std::vector<cv::Point2f>& corners) {
  cv::Mat tag(10, 10, CV_8UC1, cv::Scalar(255)), drawn;
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11), id, 8,
                        drawn);
  drawn.copyTo(tag(cv::Rect(1, 1, 8, 8)));
  cv::Mat large, image(1200, 1600, CV_8UC1, cv::Scalar(200));
  cv::resize(tag, large, {1000, 1000}, 0, 0, cv::INTER_NEAREST);
  std::vector<cv::Point2f> to;
  for (const cv::Point2f& corner :
       corners)  // of the image four times as large, whose pixels are averaged
    to.emplace_back(4.0f * corner.x + 1.5f, 4.0f * corner.y + 1.5f);
  const std::vector<cv::Point2f> from = {
      {99.5f, 99.5f}, {899.5f, 99.5f}, {899.5f, 899.5f}, {99.5f, 899.5f}};
  cv::warpPerspective(large, image, cv::getPerspectiveTransform(from, to), image.size(),
                      cv::INTER_AREA, cv::BORDER_TRANSPARENT);
  cv::resize(image, image, {400, 300}, 0, 0, cv::INTER_AREA);
  return image;
}

std::vector<DetectedMarker> markersIn(const cv::Mat& image) {
  return detectMarkers({image.data, image.cols, image.rows, image.step}, {});
}

TEST(MarkerDetection, CornersAreFoundToAFractionOfAPixelAtAnySize) {
  for (const float side : {24.0f, 40.0f, 80.0f, 180.0f}) {
    const std::vector<cv::Point2f> corners = {
        {60.3f, 50.7f}, {60.3f + side, 52.2f}, {58.9f + side, 51.1f + side}, {61.6f, 49.8f + side}};
    const auto markers = markersIn(imageOf(5, corners));
    ASSERT_EQ(markers.size(), 1u) << side;
    EXPECT_EQ(markers[0].id, 5);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(markers[0].corners[i].x(), corners[i].x, 0.2) << side << " corner " << i;
      EXPECT_NEAR(markers[0].corners[i].y(), corners[i].y, 0.2) << side << " corner " << i;
    }
  }
}

// A sheet of paper with the same tag hung up elsewhere: none of the two is believed.
TEST(MarkerDetection, AnIdThatIsSeenTwiceIsLeftOut) {
  cv::Mat image = imageOf(3, {{20.2f, 20.2f}, {90.2f, 20.2f}, {90.2f, 90.2f}, {20.2f, 90.2f}});
  image(cv::Rect(0, 0, 110, 110)).copyTo(image(cv::Rect(200, 150, 110, 110)));
  EXPECT_TRUE(markersIn(image).empty());
}

TEST(MarkerDetection, AnImageWithoutMarkersHasNone) {
  EXPECT_TRUE(markersIn(cv::Mat(300, 400, CV_8UC1, cv::Scalar(0))).empty());
  EXPECT_TRUE(markersIn(cv::Mat(1, 1, CV_8UC1, cv::Scalar(7))).empty());
}

}  // namespace
}  // namespace grid_path_planner::vision
