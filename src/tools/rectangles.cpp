// grid_path rectangles: a map's free space as rectangles.
#include <iostream>

#include "arguments.h"
#include "commands.h"
#include "grid_path_planner/rectangles/rectangle_file.h"
#include "grid_path_planner/ros/bag.h"
#include "rectangle_answer.h"
#include "rectangle_question.h"
#include "rectangle_telling.h"

namespace grid_path_planner::tools {

int runRectangles(int argc, char** argv) {
  boost::program_options::variables_map values;
  if (!parseArguments(argc, argv, describeRectangles(), "grid_path rectangles --map FILE [options]",
                      values))
    return 0;
  const RectangleQuestion question = rectangleQuestionFrom(values);
  const OccupancyGrid map = readAnyMapFile(question.map, question.reading);
  const RectangleAnswer answer = answerOf(question, map);
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
