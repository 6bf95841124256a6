// grid_path rectangles: a map's free space as rectangles.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "arguments.h"
#include "commands.h"
#include "grid_path_planner/path/picture.h"
#include "grid_path_planner/rectangles/decomposition.h"
#include "grid_path_planner/rectangles/free_cells.h"
#include "grid_path_planner/rectangles/map_sizes.h"
#include "grid_path_planner/rectangles/rectangle_file.h"
#include "grid_path_planner/rectangles/rectangle_graph.h"
#include "grid_path_planner/rectangles/rectangle_route.h"
#include "grid_path_planner/ros/bag.h"

namespace grid_path_planner::tools {
namespace {

namespace po = boost::program_options;

po::options_description describe() {
  po::options_description known("Options");
  known.add_options()("map", po::value<std::string>()->required(), kMapFiles)(
      "resolution", po::value<std::string>(),
      "side of the map's cells instead of its own; of a drawing, how finely it is read [m]")(
      "unknown-is-free", "cut unknown cells into rectangles too")(
      "partition", po::value<std::string>(),
      "largest_first: the published R-map; merged_runs: quicker, in no such order; default "
      "largest_first")("limit", po::value<std::string>(), "no more rectangles than these")(
      "min-area", po::value<std::string>(), "no rectangle smaller than this [cells]")(
      "weight", po::value<std::string>(),
      "tell the connections too, and what a step over each weighs "
      "(area|border|distance|connections, or length: through the middle of the border)")(
      "corners", "rectangles that touch at a corner only are connected too")(
      "image", po::value<std::string>(),
      "write a picture: rectangles with their numbers from 1, connections with --weight")(
      "output", po::value<std::string>(), "write the rectangles as a compact file")(
      "memory-limit", po::value<std::string>(),
      "refuse a map that may need more, before it is cut [MB]; default 6000")(
      "json", "print one JSON object instead of sentences");
  return known;
}

struct Question {
  std::string map;
  MapFileOptions reading;
  bool unknown_is_free = false;
  bool merged_runs = false;
  DecompositionLimits limits;
  std::optional<RectangleWeight> weight;
  Touching touching = Touching::BORDERS;
  std::int64_t memory_limit = SearchOptions().memory_limit;  // MB
};

std::int64_t countFrom(const po::variables_map& values, const std::string& name) {
  const std::string& text = values[name].as<std::string>();
  const double number = numbersOf(name, text, 1, 1)[0];
  if (number != std::floor(number) || number < 1.0 || number > 1e15)
    throw InputError("--" + name + " must be a whole number from 1, got '" + text + "'");
  return static_cast<std::int64_t>(number);
}

bool asksForMergedRuns(const po::variables_map& values) {
  if (values.count("partition") == 0) return false;
  const std::string& name = values["partition"].as<std::string>();
  if (name != "largest_first" && name != "merged_runs")
    throw InputError("--partition must be largest_first or merged_runs, got '" + name + "'");
  return name == "merged_runs";
}

Question questionOf(const po::variables_map& values) {
  Question question;
  question.map = values["map"].as<std::string>();
  question.reading = readingOptionsFrom(values);
  question.unknown_is_free = values.count("unknown-is-free") != 0;
  question.merged_runs = asksForMergedRuns(values);
  if (values.count("limit") != 0 && values.count("min-area") != 0)
    throw InputError("--limit and --min-area do not go together");
  if (question.merged_runs && values.count("limit") + values.count("min-area") != 0)
    throw InputError("--limit and --min-area are for --partition largest_first");
  if (values.count("limit") != 0)
    question.limits.count = static_cast<std::size_t>(countFrom(values, "limit"));
  if (values.count("min-area") != 0) question.limits.smallest_area = countFrom(values, "min-area");
  if (values.count("weight") != 0)
    question.weight =
        choiceFromName<RectangleWeight>("--weight", values["weight"].as<std::string>());
  if (values.count("memory-limit") != 0) question.memory_limit = countFrom(values, "memory-limit");
  if (values.count("corners") != 0) question.touching = Touching::BORDERS_AND_CORNERS;
  return question;
}

// The map with its last row first.
OccupancyGrid turnedOver(const OccupancyGrid& map) {
  OccupancyGrid turned(map.geometry());
  for (int row = 0; row < map.height(); ++row)
    std::copy_n(map.row(row), map.width(), turned.row(map.height() - 1 - row));
  return turned;
}

struct Answer {
  std::vector<CellRect> in_file;  // rows as the file has them
  RectangleGraph map;             // the same, in the same order, rows as in Cell
  MapSizes sizes;
  double time_ms = 0.0;
};

std::size_t bytesAllowed(const Question& question) {
  return static_cast<std::size_t>(question.memory_limit) * 1000000;
}

// `bytes` are needed, or more.
[[noreturn]] void refuse(const Question& question, std::size_t bytes) {
  throw InputError(question.map, "needs " + std::to_string(bytes / 1000000 + 1) +
                                     " MB or more to be cut into rectangles, more than "
                                     "--memory-limit " +
                                     std::to_string(question.memory_limit));
}

// Throws InputError before memory is taken.
std::vector<CellRect> cutWithinMemory(const Question& question, const GridGeometry& geometry,
                                      const BitMaps& free) {
  const std::size_t expected = largestFirstBytes(geometry, countRuns(free.rows));
  if (expected > bytesAllowed(question)) refuse(question, expected);
  DecompositionLimits limits = question.limits;
  limits.bytes = bytesAllowed(question);
  try {
    return question.merged_runs ? mergedRuns(free.rows, {}) : largestFirst(free, limits, {});
  } catch (const DecompositionTooLarge&) {
    refuse(question, limits.bytes);
  }
}

// Cut as the file has its rows, since the order among equal rectangles depends on it: the same
// picture gives the same rectangles in any format.
Answer answerOf(const Question& question, const OccupancyGrid& map) {
  const bool over = rowOrderOf(question.map) == RowOrder::LAST_ROW_FIRST;
  const BitMaps free = freeCellsOf(over ? turnedOver(map) : map, {}, question.unknown_is_free, {});
  Answer answer;
  const auto begin = std::chrono::steady_clock::now();
  answer.in_file = cutWithinMemory(question, map.geometry(), free);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  answer.time_ms = time.count();
  const std::size_t needed = RectangleGraph::bytesFor(answer.in_file.size());
  if (needed > bytesAllowed(question)) refuse(question, needed);
  std::vector<CellRect> rectangles = answer.in_file;
  if (over)
    for (CellRect& rect : rectangles) rect.row = map.height() - rect.row - rect.height;
  answer.map = RectangleGraph(map.geometry(), std::move(rectangles), question.touching);
  answer.sizes = mapSizes(answer.map);
  return answer;
}

Eigen::Vector2d centreOf(const CellRect& rect) {
  return {rect.column + 0.5 * rect.width, rect.row + 0.5 * rect.height};
}

// From centre to centre through the cells on both sides of the border's middle, in cells. A planner
// measures the same from where it crossed into `from`.
double lengthThrough(const RectangleGraph& map, std::uint32_t from, const Connection& step) {
  const Eigen::Vector2d a = centreOf(map.rectangles()[from]),
                        b = centreOf(map.rectangles()[step.to]);
  if (step.side == Side::CORNER) return (a - b).norm();
  const auto [outward, inward] = middleOf(map.rectangles()[from], step);
  const auto centre = [](Cell cell) { return Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5); };
  return (centre(outward) - a).norm() + 1.0 + (centre(inward) - b).norm();
}

double weightOf(const RectangleGraph& map, RectangleWeight weight, std::uint32_t from,
                const Connection& step) {
  return weight == RectangleWeight::LENGTH ? lengthThrough(map, from, step)
                                           : stepWeight(map, weight, from, step);
}

template <class Visit>
void visitConnections(const RectangleGraph& map, Visit&& visit) {
  for (std::uint32_t from = 0; from < map.rectangles().size(); ++from)
    for (const Connection& step : map.connections().of(from)) visit(from, step);
}

// ---- Telling

nlohmann::json jsonOf(const MapSizes& sizes) {
  return {{"entire_map", sizes.entire_map},
          {"empty_cells", sizes.empty_cells},
          {"rectangles", sizes.rectangles},
          {"file", sizes.file},
          {"png", sizes.png},
          {"zlib", sizes.zlib}};
}

nlohmann::json jsonOf(const Question& question, const Answer& answer) {
  nlohmann::json rectangles = nlohmann::json::array();
  for (const CellRect& rect : answer.in_file)
    rectangles.push_back({rect.column, rect.row, rect.width, rect.height});
  nlohmann::json object = {{"cells", answer.map.geometry().size()},
                           {"cells_in_rectangles", answer.map.freeCells()},
                           {"count", answer.in_file.size()},
                           {"connections", answer.map.connections().count() / 2},
                           {"bytes", answer.sizes.file},
                           {"sizes", jsonOf(answer.sizes)},
                           {"time_ms", answer.time_ms},
                           {"rectangles", std::move(rectangles)}};
  if (!question.weight) return object;
  nlohmann::json weights = nlohmann::json::array();
  visitConnections(answer.map, [&](std::uint32_t from, const Connection& step) {
    weights.push_back({from, step.to, weightOf(answer.map, *question.weight, from, step)});
  });
  object["weights"] = std::move(weights);
  return object;
}

std::string counted(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

void print(const Question& question, const Answer& answer) {
  const GridGeometry& geometry = answer.map.geometry();
  const MapSizes& sizes = answer.sizes;
  std::cout << question.map << ": " << geometry.width() << "x" << geometry.height() << " cells, "
            << answer.map.freeCells() << " of them in "
            << counted(answer.in_file.size(), "rectangle") << " with "
            << counted(answer.map.connections().count() / 2, "connection") << ", cut in "
            << std::setprecision(3) << answer.time_ms << " ms\n"
            << "bytes: " << sizes.file << " as a file, " << sizes.rectangles
            << " as a list of rectangles, " << sizes.empty_cells << " as a list of free cells; "
            << sizes.entire_map << " as bits, " << sizes.png << " as PNG, " << sizes.zlib
            << " as bits in zlib\n"
            << std::setprecision(6);
  if (!question.weight) return;
  visitConnections(answer.map, [&](std::uint32_t from, const Connection& step) {
    std::cout << from + 1 << " -> " << step.to + 1 << ": "
              << weightOf(answer.map, *question.weight, from, step) << '\n';
  });
}

// Between the centres of the rectangles and the middle of their border.
std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> linksOf(const RectangleGraph& map) {
  const GridGeometry& geometry = map.geometry();
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> links;
  visitConnections(map, [&](std::uint32_t from, const Connection& step) {
    const CellRect &a = map.rectangles()[from], &b = map.rectangles()[step.to];
    if (from < step.to)
      links.emplace_back(geometry.worldFromGrid(centreOf(a)), geometry.worldFromGrid(centreOf(b)));
  });
  return links;
}

void draw(const std::string& file, const Question& question, const Answer& answer,
          const OccupancyGrid& map) {
  PictureContent content;
  content.rectangles = answer.map.rectangles();
  if (question.weight) content.links = linksOf(answer.map);
  writePicture(file, map, {}, content);
}

}  // namespace

int runRectangles(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, describe(), "grid_path rectangles --map FILE [options]", values))
    return 0;
  const Question question = questionOf(values);
  const OccupancyGrid map = readAnyMapFile(question.map, question.reading);
  const Answer answer = answerOf(question, map);
  if (values.count("image") != 0) draw(values["image"].as<std::string>(), question, answer, map);
  if (values.count("output") != 0)
    writeRectangleFile(values["output"].as<std::string>(), answer.map);
  if (values.count("json") != 0)
    std::cout << jsonOf(question, answer).dump() << '\n';
  else
    print(question, answer);
  return 0;
}

}  // namespace grid_path_planner::tools
