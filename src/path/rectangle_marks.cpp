#include "path/rectangle_marks.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

namespace grid_path_planner::path {

using grid::CellRect, grid::GridGeometry;

namespace {

const Colour kOutline = colourOf(70, 78, 92);
const Colour kNumber = colourOf(30, 34, 40);
const Colour kLink = colourOf(160, 40, 70);
constexpr int kSmallestOutlined = 5;  // pixels

// Light, so that outlines and numbers stand out; after Brewer's Set3.
const Colour kTints[] = {colourOf(176, 219, 211), colourOf(253, 237, 176), colourOf(205, 201, 226),
                         colourOf(250, 186, 178), colourOf(171, 205, 228), colourOf(252, 205, 157),
                         colourOf(204, 228, 161), colourOf(248, 217, 233)};

// The pixels that the rectangle covers; empty outside the map.
cv::Rect pixelsOf(const CellRect& rect, const PictureLayout& layout, const GridGeometry& geometry) {
  const CellRect inside = rect.intersection(geometry.rect());
  if (inside.empty()) return {};
  const Eigen::Vector2d low = layout.pixelAt(geometry.worldFromGrid({inside.column, inside.row}));
  const Eigen::Vector2d high = layout.pixelAt(
      geometry.worldFromGrid({inside.column + inside.width, inside.row + inside.height}));
  const int left = cvRound(low.x()), top = cvRound(high.y());
  return {left, top, std::max(1, cvRound(high.x()) - left), std::max(1, cvRound(low.y()) - top)};
}

// In the middle, as large as fits up to a size that reads well; nothing where that is too small.
// On a ground of its own, since links may run through it.
void drawNumber(Canvas& canvas, const cv::Rect& pixels, std::size_t number, const Colour& ground) {
  if (pixels.empty()) return;
  constexpr double kLargest = 0.8, kSmallest = 0.28, kHeight = 22.0;  // of scale 1, pixels
  const std::string text = std::to_string(number);
  const double scale = std::min(
      {kLargest, 0.8 * pixels.width / textWidth(text, 1.0), 0.7 * pixels.height / kHeight});
  if (scale < kSmallest) return;
  const double width = textWidth(text, scale);
  const Eigen::Vector2d middle(pixels.x + pixels.width / 2.0, pixels.y + pixels.height / 2.0);
  const Eigen::Vector2d left = middle - Eigen::Vector2d(width / 2.0, 0.0);
  const double height = 1.3 * kHeight * scale;
  const cv::Rect text_box(cvRound(left.x()) - 1, cvRound(middle.y() - height / 2.0),
                          cvRound(width) + 2, cvRound(height));
  const cv::Rect inside(pixels.x + 1, pixels.y + 1, pixels.width - 2, pixels.height - 2);
  canvas.part(text_box & inside).setTo(cv::Scalar(ground));
  canvas.text(text, left, scale, kNumber);
}

}  // namespace

void drawRectangles(Canvas& canvas, const PictureLayout& layout, const GridGeometry& geometry,
                    const std::vector<CellRect>& rectangles) {
  const cv::Rect whole(0, 0, layout.width(), layout.height());
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    const cv::Rect pixels = pixelsOf(rectangles[i], layout, geometry) & whole;
    if (pixels.empty()) continue;
    cv::Mat part = canvas.part(pixels);
    part.setTo(cv::Scalar(kTints[i % std::size(kTints)]));
    if (std::min(pixels.width, pixels.height) >= kSmallestOutlined)
      cv::rectangle(part, cv::Rect(0, 0, part.cols, part.rows), cv::Scalar(kOutline), 1);
  }
}

void drawNumbers(Canvas& canvas, const PictureLayout& layout, const GridGeometry& geometry,
                 const std::vector<CellRect>& rectangles) {
  for (std::size_t i = 0; i < rectangles.size(); ++i)
    drawNumber(canvas, pixelsOf(rectangles[i], layout, geometry), i + 1,
               kTints[i % std::size(kTints)]);
}

void drawLinks(Canvas& canvas, const PictureLayout& layout,
               const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& links) {
  constexpr std::size_t kMostDotted = 1000;  // more would hide the map
  const double stroke =
      links.size() > kMostDotted ? 1.0 : std::clamp(layout.mapArea().width / 600.0, 1.0, 3.0);
  for (const auto& [from, to] : links) {
    const Eigen::Vector2d a = layout.pixelAt(from), b = layout.pixelAt(to);
    canvas.line(a, b, kLink, stroke);
    if (links.size() > kMostDotted) continue;
    canvas.disc(a, 1.6 * stroke, kLink);
    canvas.disc(b, 1.6 * stroke, kLink);
  }
}

void drawRectangleSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size) {
  const Eigen::Vector2d aside(0.8 * size, 0.0);
  canvas.swatch(at - aside, size, kTints[0], kOutline);
  canvas.swatch(at + aside, size, kTints[1], kOutline);
}

void drawLinkSymbol(Canvas& canvas, const Eigen::Vector2d& at, double size) {
  const Eigen::Vector2d aside(1.5 * size, 0.0);
  canvas.line(at - aside, at + aside, kLink, 0.3 * size);
  canvas.disc(at - aside, 0.5 * size, kLink);
  canvas.disc(at + aside, 0.5 * size, kLink);
}

}  // namespace grid_path_planner::path
