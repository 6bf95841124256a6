#include "grid_path_planner/path/path_image.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "grid/segment.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "path/canvas.h"
#include "path/rectangle_marks.h"

namespace grid_path_planner::path {

using base::InputError, base::writeFileAtomically;
using grid::Cell, grid::CellRect, grid::distanceBetween, grid::GridGeometry, grid::Occupancy,
    grid::OccupancyGrid, grid::OccupancyThresholds;

namespace {

const Colour kPaper = colourOf(255, 255, 255);
const Colour kInk = colourOf(52, 58, 66);
const Colour kFree = colourOf(247, 247, 244);
const Colour kUnknown = colourOf(186, 190, 196);
const Colour kOccupied = colourOf(44, 49, 57);
const Colour kEarly = colourOf(255, 243, 190);
const Colour kLate = colourOf(240, 178, 72);
// Of the palette of Okabe and Ito, 2008.
const Colour kPath = colourOf(0, 114, 178);
const Colour kVehicleOutline = colourOf(86, 180, 233);
const Colour kStart = colourOf(0, 158, 115);
const Colour kGoal = colourOf(213, 94, 0);

Colour cellColour(Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::FREE:
      return kFree;
    case Occupancy::UNKNOWN:
      return kUnknown;
    case Occupancy::OCCUPIED:
      return kOccupied;
  }
  return kInk;
}

// ---- The map

// The class of every block of cells that share a pixel, row 0 first: the last in the order of
// Occupancy that any of them has.
cv::Mat blockClasses(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                     const cv::Size& size, int cells) {
  cv::Mat classes(size, CV_8U, cv::Scalar(0));
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      uchar& block = classes.at<uchar>(row / cells, column / cells);
      block = std::max(block, static_cast<uchar>(thresholds.classify(map[Cell{column, row}])));
    }
  return classes;
}

cv::Mat coloured(const cv::Mat& classes) {
  cv::Mat colours(classes.size(), CV_8UC3);
  for (int y = 0; y < classes.rows; ++y)
    for (int x = 0; x < classes.cols; ++x)
      colours.at<Colour>(y, x) = cellColour(Occupancy(classes.at<uchar>(y, x)));
  return colours;
}

// Unknown and occupied cells that were expanded can still be told.
void tint(cv::Mat& colours, const cv::Mat& classes, int cells, const GridGeometry& geometry,
          const std::vector<Cell>& expanded) {
  for (std::size_t i = 0; i < expanded.size(); ++i) {
    if (!geometry.contains(expanded[i])) continue;
    const cv::Point block(expanded[i].column / cells, expanded[i].row / cells);
    const Occupancy occupancy = Occupancy(classes.at<uchar>(block));
    const Colour colour = mixed(kEarly, kLate, static_cast<double>(i) / expanded.size());
    const double strength = occupancy == Occupancy::FREE ? 1.0 : 0.3;
    colours.at<Colour>(block) = mixed(cellColour(occupancy), colour, strength);
  }
}

void darkenGridLines(cv::Mat& map, int step) {
  const auto darken = [](cv::Mat line) { line.convertTo(line, -1, 0.92); };
  for (int x = step; x < map.cols; x += step) darken(map.col(x));
  for (int y = step; y < map.rows; y += step) darken(map.row(y));
}

void drawMap(Canvas& canvas, const PictureLayout& layout, const OccupancyGrid& map,
             const OccupancyThresholds& thresholds, const std::vector<Cell>& expanded) {
  constexpr int kGridFrom = 14;  // pixels a cell
  const CellRect area = layout.mapArea();
  const cv::Size blocks(area.width / layout.enlarged(), area.height / layout.enlarged());
  const cv::Mat classes = blockClasses(map, thresholds, blocks, layout.reduced());
  cv::Mat colours = coloured(classes);
  tint(colours, classes, layout.reduced(), map.geometry(), expanded);
  cv::flip(colours, colours, 0);

  cv::Mat target = canvas.part({area.column, area.row, area.width, area.height});
  cv::resize(colours, target, target.size(), 0, 0, cv::INTER_NEAREST);
  if (layout.enlarged() >= kGridFrom) darkenGridLines(target, layout.enlarged());
  cv::Mat framed = canvas.part({area.column - 1, area.row - 1, area.width + 2, area.height + 2});
  cv::rectangle(framed, cv::Rect(0, 0, framed.cols, framed.rows), cv::Scalar(kInk), 1);
}

// ---- The path

// The width of the path, in pixels.
double strokeOf(const PictureLayout& layout) {
  constexpr double kThin = 3.0, kThick = 14.0;
  const CellRect area = layout.mapArea();
  const double of_map = std::max(area.width, area.height) / 300.0;
  const double of_cell = 0.09 * layout.enlarged();
  return std::clamp(std::max(of_map, of_cell), kThin, kThick);
}

// Whether `b` lies on the segment from `a` to `c`, but for a hundredth of a pixel.
bool isBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).dot(c - b) >= 0.0 && distanceBetween({a, c}, {b, b}) < 0.01;
}

// The corners of the path in pixels: a line drawn in one piece has no seams.
std::vector<Eigen::Vector2d> cornersOf(const Path& path, const PictureLayout& layout) {
  std::vector<Eigen::Vector2d> corners;
  for (const Pose& pose : path.poses) {
    const Eigen::Vector2d next = layout.pixelAt(pose.position.head<2>());
    while (corners.size() >= 2 && isBetween(corners[corners.size() - 2], corners.back(), next))
      corners.pop_back();
    corners.push_back(next);
  }
  return corners;
}

void drawPolyline(Canvas& canvas, const std::vector<Eigen::Vector2d>& corners, const Colour& colour,
                  double thickness) {
  for (std::size_t i = 1; i < corners.size(); ++i)
    canvas.line(corners[i - 1], corners[i], colour, thickness);
}

void drawStart(Canvas& canvas, const Eigen::Vector2d& at, double size) {
  canvas.disc(at, 1.5 * size, kInk);
  canvas.disc(at, 1.32 * size, kPaper);
  canvas.disc(at, size, kStart);
}

void drawGoal(Canvas& canvas, const Eigen::Vector2d& at, double angle, double size) {
  canvas.arrowhead(at, angle, 1.75 * size, kInk);
  canvas.arrowhead(at, angle, 1.58 * size, kPaper);
  canvas.arrowhead(at, angle, size, kGoal);
}

bool shows(const PictureLayout& layout, const Eigen::Vector2d& at) {
  return at.minCoeff() >= 0.0 && at.x() <= layout.width() && at.y() <= layout.height();
}

void drawPath(Canvas& canvas, const PictureLayout& layout, const Path& path, double map_yaw) {
  if (path.empty()) return;
  const double stroke = strokeOf(layout);
  const std::vector<Eigen::Vector2d> corners = cornersOf(path, layout);
  drawPolyline(canvas, corners, kPaper, stroke + 2.0 * std::max(1.0, 0.25 * stroke));
  drawPolyline(canvas, corners, kPath, stroke);
  if (shows(layout, corners.front())) drawStart(canvas, corners.front(), 2.0 * stroke);
  if (shows(layout, corners.back()))
    drawGoal(canvas, corners.back(), path.poses.back().yaw - map_yaw, 2.0 * stroke);
}

void drawOutlines(Canvas& canvas, const PictureLayout& layout,
                  const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
  const double thickness = std::max(1.0, 0.25 * strokeOf(layout));
  for (const std::vector<Eigen::Vector2d>& outline : outlines) {
    std::vector<Eigen::Vector2d> corners;
    for (std::size_t i = 0; i <= outline.size(); ++i)
      corners.push_back(layout.pixelAt(outline[i % outline.size()]));
    drawPolyline(canvas, corners, kVehicleOutline, thickness);
  }
}

// ---- The margin

double textScale(const PictureLayout& layout) {
  return layout.margin() / 80.0;
}

// A bar of 1, 2 or 5 times a power of ten metres, at most a sixth of the picture wide. Gives the x
// where it ends.
double drawScaleBar(Canvas& canvas, const PictureLayout& layout, double resolution,
                    const Eigen::Vector2d& at) {
  const double pixels_a_metre = layout.enlarged() / (layout.reduced() * resolution);
  const double most = layout.width() / 6.0 / pixels_a_metre;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double metres = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
  const Eigen::Vector2d end = at + Eigen::Vector2d(metres * pixels_a_metre, 0.0);
  const Eigen::Vector2d tick(0.0, layout.margin() / 6.0);
  canvas.line(at, end, kInk, 2.0);
  canvas.line(at - tick, at + tick, kInk, 2.0);
  canvas.line(end - tick, end + tick, kInk, 2.0);
  char label[32];
  std::snprintf(label, sizeof label, "%g m", metres);
  const Eigen::Vector2d gap(layout.margin() / 3.0, 0.0);
  return canvas.text(label, end + gap, textScale(layout), kInk);
}

// What the symbols mean, from `at` on; what has no room is left out.
void drawLegend(Canvas& canvas, const PictureLayout& layout, Eigen::Vector2d at,
                const PictureContent& content) {
  const bool with_path = !content.path.empty();
  const double size = layout.margin() / 5.5, scale = textScale(layout);
  const Eigen::Vector2d half(1.5 * size, 0.0);
  const auto item = [&](bool shown, const std::string& name, const auto& drawSymbol) {
    const double end = at.x() + 4.0 * size + textWidth(name, scale);
    if (!shown || end > layout.width() - size) return;
    drawSymbol(at + half);
    canvas.text(name, at + Eigen::Vector2d(4.0 * size, 0.0), scale, kInk);
    at.x() = end + 2.0 * size;
  };
  const auto swatch = [&](const Colour& colour) {
    return
        [&canvas, size, colour](const auto& middle) { canvas.swatch(middle, size, colour, kInk); };
  };
  item(with_path, "start", [&](const auto& middle) { drawStart(canvas, middle, 0.8 * size); });
  item(with_path, "goal",
       [&](const auto& middle) { drawGoal(canvas, middle, M_PI / 4, 0.55 * size); });
  item(with_path, "path",
       [&](const auto& middle) { canvas.line(middle - half, middle + half, kPath, 0.6 * size); });
  item(!content.outlines.empty(), "vehicle", [&](const auto& middle) {
    canvas.line(middle - half, middle + half, kVehicleOutline, 0.3 * size);
  });
  item(!content.expanded.empty(), "expanded, first to last", [&](const auto& middle) {
    const Eigen::Vector2d aside(0.8 * size, 0.0);
    canvas.swatch(middle - aside, size, kEarly, kInk);
    canvas.swatch(middle + aside, size, kLate, kInk);
  });
  item(!content.rectangles.empty(), "rectangles",
       [&](const auto& middle) { drawRectangleSymbol(canvas, middle, size); });
  item(!content.links.empty(), "connections",
       [&](const auto& middle) { drawLinkSymbol(canvas, middle, size); });
  item(true, "occupied", swatch(kOccupied));
  item(true, "unknown", swatch(kUnknown));
  item(true, "free", swatch(kFree));
}

void drawMargin(Canvas& canvas, const PictureLayout& layout, double resolution,
                const PictureContent& content) {
  const double margin = layout.margin(), y = layout.height() - 0.95 * margin;
  const double end = drawScaleBar(canvas, layout, resolution, {margin, y});
  drawLegend(canvas, layout, {end + margin, y}, content);
}

// ---- Everything

Canvas drawn(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
             const PictureContent& content, const PictureOptions& options) {
  const Path& path = content.path;
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    if (!path.poses[i].position.allFinite() || !std::isfinite(path.poses[i].yaw))
      throw InputError("pose " + std::to_string(i + 1) + " of the path to draw is not finite");
  const PictureLayout layout(map.geometry(), options);
  Canvas canvas(layout.width(), layout.height(), kPaper);
  drawMap(canvas, layout, map, thresholds, content.expanded);
  drawRectangles(canvas, layout, map.geometry(), content.rectangles);
  drawLinks(canvas, layout, content.links);
  drawNumbers(canvas, layout, map.geometry(), content.rectangles);
  drawOutlines(canvas, layout, content.outlines);
  drawPath(canvas, layout, path, map.geometry().origin().yaw);
  drawMargin(canvas, layout, map.geometry().resolution(), content);
  return canvas;
}

std::string extensionOf(const std::string& file) {
  const std::size_t dot = file.find_last_of("./");
  return dot == std::string::npos || file[dot] == '/' ? "" : file.substr(dot);
}

}  // namespace

Picture drawPicture(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                    const PictureContent& content, const PictureOptions& options) {
  cv::Mat image;
  cv::cvtColor(drawn(map, thresholds, content, options).image(), image, cv::COLOR_BGR2RGB);
  return {image.cols, image.rows, {image.datastart, image.dataend}};
}

void writePicture(const std::string& file, const OccupancyGrid& map,
                  const OccupancyThresholds& thresholds, const PictureContent& content,
                  const PictureOptions& options) {
  const std::string extension = extensionOf(file);
  if (extension.empty() || !cv::haveImageWriter("picture" + extension))
    throw InputError(file, "no picture is written with this extension, use .png");
  const Canvas canvas = drawn(map, thresholds, content, options);
  std::vector<uchar> bytes;
  try {
    cv::imencode(extension, canvas.image(), bytes);
  } catch (const cv::Exception& error) {
    throw InputError(file, "the picture cannot be encoded: " + error.err);
  }
  writeFileAtomically(file, std::string(bytes.begin(), bytes.end()));
}

}  // namespace grid_path_planner::path
