// The few shapes that pictures are made of, drawn smoothly and to a sixteenth of a pixel. Points
// are pixels from the outer corner of the upper left one, y down.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>

namespace grid_path_planner::path {

using Colour = cv::Vec3b;  // blue, green, red

Colour colourOf(int red, int green, int blue);
Colour mixed(const Colour& a, const Colour& b, double share_of_b);

class Canvas {
 public:
  Canvas(int width, int height, const Colour& paper)
      : image_(height, width, CV_8UC3, cv::Scalar(paper)) {}

  const cv::Mat& image() const { return image_; }
  // The pixels of a part, to be written to.
  cv::Mat part(const cv::Rect& rect) { return image_(rect); }

  // What of the line lies far outside is left out.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour,
            double thickness);
  void disc(const Eigen::Vector2d& at, double radius, const Colour& colour);
  // An arrowhead around `at` that points along `angle` (radians, anticlockwise from the right),
  // about as large as a disc of radius 1.5 `size`.
  void arrowhead(const Eigen::Vector2d& at, double angle, double size, const Colour& colour);
  // A filled square with a border, 2 `size` wide.
  void swatch(const Eigen::Vector2d& at, double size, const Colour& colour, const Colour& border);
  // Gives the x where the text ends. `at`: the middle of its left edge.
  double text(const std::string& text, const Eigen::Vector2d& at, double scale,
              const Colour& colour);

 private:
  cv::Mat image_;
};

// Pixels.
double textWidth(const std::string& text, double scale);

}  // namespace grid_path_planner::path
