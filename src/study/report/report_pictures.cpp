#include "study/report/report_pictures.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "study/report/report.h"
#include "study/report/svg_chart.h"
#include "study/study_worker.h"

namespace grid_path_planner::study {

using base::choiceName, base::Status, base::StopToken;
using costmap::CostmapBuilder;
using grid::Cell, grid::Grid, grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid,
    grid::OccupancyThresholds;

namespace {

using nlohmann::json;

cv::Vec3b colourOf(Occupancy occupancy) {  // blue, green, red
  switch (occupancy) {
    case Occupancy::FREE:
      return {246, 248, 248};
    case Occupancy::UNKNOWN:
      return {196, 192, 188};
    case Occupancy::OCCUPIED:
      break;
  }
  return {74, 66, 60};
}

std::string base64(const std::vector<unsigned char>& bytes) {
  static const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned group =
        bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    out += letters[group >> 18];
    out += letters[group >> 12 & 63];
    out += left > 1 ? letters[group >> 6 & 63] : '=';
    out += left > 2 ? letters[group & 63] : '=';
  }
  return out;
}

// The first row of the map is the last of the image.
std::string imageOf(const Grid<Occupancy>& classes) {
  cv::Mat image(classes.height(), classes.width(), CV_8UC3);
  for (int row = 0; row < classes.height(); ++row)
    for (int column = 0; column < classes.width(); ++column)
      image.at<cv::Vec3b>(classes.height() - 1 - row, column) =
          colourOf(classes[Cell{column, row}]);
  std::vector<unsigned char> png;
  cv::imencode(".png", image, png);
  return "data:image/png;base64," + base64(png);
}

json pointsOf(const StudyRun& run, const GridGeometry& geometry) {
  json points = json::array();
  for (const Eigen::Vector2d& at : cornersInPicture(run, geometry)) {
    points.push_back(at.x());
    points.push_back(at.y());
  }
  return points;
}

std::string resultText(const StudyRun& run) {
  if (run.status != Status::FOUND) return std::string(toString(run.status));
  return "cost " + shownNumber(run.cost, 5) + ", " + shownNumber(run.length_m, 4) + " m, " +
         shownNumber(static_cast<double>(run.expanded), 6) + " cells expanded";
}

json unitOf(const StudyData& data, const UnitRow& row, const GridGeometry& geometry) {
  json unit = {{"paths", json::array()}};
  for (const StudyRun* run : row) {
    if (run == nullptr) continue;
    std::ostringstream query;
    query << run->start << " to " << run->goal;
    unit["weights"] = data.settingOf(*run).weights;
    unit["query"] = query.str();
    unit["note"] = run->note;
    unit["paths"].push_back({{"variant", run->variant},
                             {"points", pointsOf(*run, geometry)},
                             {"text", resultText(*run)},
                             {"command", planCommand(data, *run)}});
  }
  return unit;
}

// None where the map is too large.
json pictureOf(const StudyData& data, const ProblemSize& size, const StudySetting& setting) {
  const auto& map = data.plan().map(size.map);
  const GridGeometry& geometry = map->geometry();
  const auto blocks = geometry.size() / static_cast<std::size_t>(size.kernel * size.kernel);
  if (blocks > kLargestPicture) return {};
  CostmapBuilder builder(setting.costmap);
  builder.setMap(data.plan().mapOf(setting));
  const auto costs = builder.downsampled(StopToken());
  json picture = {{"name", data.study().maps[size.map].name + ", kernel " +
                               std::to_string(size.kernel) + ' ' + choiceName(size.rule) +
                               (size.border == Border::UNFILLED ? ", border unfilled" : "")},
                  {"width", geometry.width()},
                  {"height", geometry.height()},
                  // Blocks of the last column and row may reach beyond the map.
                  {"imageWidth", costs->geometry().width() * size.kernel},
                  {"imageHeight", costs->geometry().height() * size.kernel},
                  {"image", imageOf(costs->classes())},
                  {"units", json::array()}};
  for (const UnitRow& row : data.units()) {
    if (row.front() == nullptr || row.front()->query >= StudyWorker::kDrawnQueries) continue;
    const ProblemSize of = data.sizeOf(row.front()->setting);
    if (of == size) picture["units"].push_back(unitOf(data, row, geometry));
  }
  return picture;
}

}  // namespace

std::vector<Eigen::Vector2d> cornersInPicture(const StudyRun& run, const GridGeometry& geometry) {
  const auto rounded = [](double number) { return std::round(number * 100.0) / 100.0; };
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i + 1 < run.path_xy.size(); i += 2) {
    const Eigen::Vector2d cell = geometry.gridFromWorld({run.path_xy[i], run.path_xy[i + 1]});
    corners.emplace_back(rounded(cell.x()), rounded(geometry.height() - cell.y()));
  }
  return corners;
}

std::string mapImage(const OccupancyGrid& map, const OccupancyThresholds& thresholds) {
  Grid<Occupancy> classes(map.geometry());
  for (int row = 0; row < classes.height(); ++row)
    for (int column = 0; column < classes.width(); ++column)
      classes[Cell{column, row}] = thresholds.classify(map[Cell{column, row}]);
  return imageOf(classes);
}

json pictureData(const StudyData& data) {
  json result = {{"variants", json::array()}, {"pictures", json::array()}};
  for (std::size_t i = 0; i < data.study().variants.size(); ++i)
    result["variants"].push_back({{"name", data.study().variants[i].label},
                                  {"colour", seriesColour(i)},
                                  {"dash", seriesDash(i)}});
  for (const ProblemSize& size : data.sizes())
    for (std::size_t setting = 0; setting < data.study().settings.size(); ++setting) {
      const ProblemSize of = data.sizeOf(setting);
      if (of != size) continue;
      const json picture = pictureOf(data, size, data.study().settings[setting]);
      if (!picture.is_null() && !picture["units"].empty()) result["pictures"].push_back(picture);
      break;
    }
  return result;
}

}  // namespace grid_path_planner::study
