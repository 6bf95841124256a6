#include "path/canvas.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "grid/segment.h"

namespace grid_path_planner::path {

using grid::Box, grid::clipped;

namespace {

constexpr int kSubpixelBits = 4;
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;

// OpenCV counts from the middle of a pixel.
cv::Point subpixel(const Eigen::Vector2d& pixel) {
  const double scale = 1 << kSubpixelBits;
  return {cvRound((pixel.x() - 0.5) * scale), cvRound((pixel.y() - 0.5) * scale)};
}

cv::Size textSize(const std::string& text, double scale) {
  int below = 0;
  return cv::getTextSize(text, kFont, scale, 1, &below);
}

}  // namespace

Colour colourOf(int red, int green, int blue) {
  return {static_cast<uchar>(blue), static_cast<uchar>(green), static_cast<uchar>(red)};
}

Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  Colour mixture;
  for (int i = 0; i < 3; ++i)
    mixture[i] = cv::saturate_cast<uchar>(a[i] + (b[i] - a[i]) * share_of_b);
  return mixture;
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour,
                  double thickness) {
  // OpenCV's integers hold no more than a few ten thousand pixels, and an end that is cut off must
  // not show.
  const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(2.0 * thickness);
  const Box box = {-beyond, Eigen::Vector2d(image_.cols, image_.rows) + beyond};
  if (const auto part = clipped({from, to}, box))
    cv::line(image_, subpixel(part->from), subpixel(part->to), cv::Scalar(colour),
             cvRound(thickness), cv::LINE_AA, kSubpixelBits);
}

void Canvas::disc(const Eigen::Vector2d& at, double radius, const Colour& colour) {
  cv::circle(image_, subpixel(at), cvRound(radius * (1 << kSubpixelBits)), cv::Scalar(colour),
             cv::FILLED, cv::LINE_AA, kSubpixelBits);
}

void Canvas::arrowhead(const Eigen::Vector2d& at, double angle, double size, const Colour& colour) {
  const Eigen::Vector2d ahead(std::cos(angle), -std::sin(angle)), left(ahead.y(), -ahead.x());
  const Eigen::Vector2d shape[] = {{1.9, 0.0}, {-1.3, 1.35}, {-0.7, 0.0}, {-1.3, -1.35}};
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& corner : shape)
    corners.push_back(subpixel(at + size * (corner.x() * ahead + corner.y() * left)));
  cv::fillPoly(image_, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(colour),
               cv::LINE_AA, kSubpixelBits);
}

void Canvas::swatch(const Eigen::Vector2d& at, double size, const Colour& colour,
                    const Colour& border) {
  const cv::Rect square(cvRound(at.x() - size), cvRound(at.y() - size), cvRound(2 * size),
                        cvRound(2 * size));
  cv::rectangle(image_, square, cv::Scalar(colour), cv::FILLED);
  cv::rectangle(image_, square, cv::Scalar(border), 1);
}

double Canvas::text(const std::string& text, const Eigen::Vector2d& at, double scale,
                    const Colour& colour) {
  const cv::Size size = textSize(text, scale);
  cv::putText(image_, text, cv::Point(cvRound(at.x()), cvRound(at.y() + size.height / 2.0)), kFont,
              scale, cv::Scalar(colour), 1, cv::LINE_AA);
  return at.x() + size.width;
}

double textWidth(const std::string& text, double scale) {
  return textSize(text, scale).width;
}

}  // namespace grid_path_planner::path
