#include "command_line/arguments.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <type_traits>

#include "command_line/node_config.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planning/unused_options.h"
#include "planning/vehicle_options.h"

namespace grid_path_planner::command_line {

using base::closestName, base::describeOptions, base::InputError, base::numberFromText,
    base::OptionDescription, base::OptionInfo, base::OptionType, base::parseOption;
using grid::MapFileOptions;
using planning::checkPlannerOptions, planning::PlannerOptions, planning::UnusedOption,
    planning::unusedOptions;

namespace {

namespace po = boost::program_options;

std::string flagOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

// Parses the text of one option into its value.
struct FromText {
  const po::variables_map& values;

  template <class Value>
  void operator()(const char* option, Value& value, const OptionInfo& info) const {
    const std::string name = flagOf(option);
    if (values.count(name) == 0) return;
    parseOption("--" + name, values[name].as<std::string>(), info, value);
  }
};

// The arguments with hyphens in the names of options, which messages and parameters spell with
// underscores.
std::vector<std::string> hyphenated(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  for (std::string& argument : arguments) {
    if (argument.compare(0, 2, "--") != 0) continue;
    const auto end = std::find(argument.begin(), argument.end(), '=');
    std::replace(argument.begin(), end, '_', '-');
  }
  return arguments;
}

// "--start and --goal are" for the required options that are missing; empty: none is.
std::string missingOf(const po::options_description& known, const po::variables_map& values) {
  std::vector<std::string> missing;
  for (const auto& option : known.options())
    if (option->semantic()->is_required() && values.count(option->long_name()) == 0)
      missing.push_back("--" + option->long_name());
  std::string list;
  for (std::size_t i = 0; i < missing.size(); ++i)
    list += (i == 0 ? "" : i + 1 == missing.size() ? " and " : ", ") + missing[i];
  return list + (missing.empty() ? "" : missing.size() == 1 ? " is" : " are");
}

po::parsed_options parsedBy(po::command_line_parser parser, const po::options_description& known) {
  try {
    return parser.run();
  } catch (const po::unknown_option& error) {
    std::vector<std::string> names;
    for (const auto& option : known.options()) names.push_back("--" + option->long_name());
    const std::string meant = closestName(error.get_option_name(), names);
    throw InputError("there is no option " + error.get_option_name() +
                     (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

void printForCompletion(const po::options_description& known) {
  std::map<std::string, std::vector<std::string>> choices;
  for (const OptionDescription& option : describeOptions(PlannerOptions()))
    choices[flagOf(option.name)] = option.type == OptionType::TRUTH
                                       ? std::vector<std::string>{"true", "false"}
                                       : option.choices;
  for (const auto& option : known.options()) {
    std::cout << "--" << option->long_name();
    for (const std::string& choice : choices[option->long_name()]) std::cout << ' ' << choice;
    std::cout << '\n';
  }
}

}  // namespace

bool parseArguments(int argc, char** argv, const po::options_description& known,
                    const std::string& usage, po::variables_map& values) {
  namespace style = po::command_line_style;
  const int long_only = style::allow_long | style::long_allow_adjacent | style::long_allow_next;
  po::options_description all(known);
  all.add_options()("help", "print this");
  const std::vector<std::string> arguments = hyphenated(argc, argv);
  if (arguments == std::vector<std::string>{"--complete"}) {
    printForCompletion(all);
    return false;
  }
  const po::parsed_options parsed =
      parsedBy(po::command_line_parser(arguments).options(all).style(long_only), all);
  for (const po::option& option : parsed.options)
    if (option.position_key >= 0)
      throw InputError("what is '" + option.value.front() + "'? Options are given as --name VALUE");
  po::store(parsed, values);
  if (values.count("help") != 0) {
    std::cout << "usage: " << usage << "\n\n" << all << '\n';
    return false;
  }
  const std::string missing = missingOf(all, values);
  if (!missing.empty()) throw InputError(missing + " missing; usage: " + usage);
  po::notify(values);
  return true;
}

std::vector<double> numbersOf(const std::string& name, const std::string& text, std::size_t fewest,
                              std::size_t most) {
  std::vector<double> numbers;
  std::istringstream parts(text + ",");
  for (std::string part; std::getline(parts, part, ',');)
    numbers.push_back(numberFromText("--" + name, part));
  if (numbers.size() >= fewest && numbers.size() <= most) return numbers;
  throw InputError("--" + name + " needs " + std::to_string(fewest) +
                   (most > fewest ? " to " + std::to_string(most) : "") +
                   " numbers separated by commas, got '" + text + "'");
}

std::int64_t countFrom(const po::variables_map& values, const std::string& name) {
  const std::string& text = values[name].as<std::string>();
  const double number = numbersOf(name, text, 1, 1)[0];
  if (number != std::floor(number) || number < 1.0 || number > 1e15)
    throw InputError("--" + name + " must be a whole number from 1, got '" + text + "'");
  return static_cast<std::int64_t>(number);
}

MapFileOptions readingOptionsFrom(const po::variables_map& values) {
  MapFileOptions options;
  options.warn = [](const std::string& warning) { std::cerr << "warning: " << warning << '\n'; };
  options.plain_image.otsu = values.count("otsu") != 0;
  if (values.count("columns") != 0)
    options.plain_image.columns = static_cast<int>(
        std::min<std::int64_t>(countFrom(values, "columns"), std::numeric_limits<int>::max()));
  if (values.count("topic") != 0) options.bag_topic = values["topic"].as<std::string>();
  if (values.count("resolution") == 0) return options;
  const std::string& text = values["resolution"].as<std::string>();
  options.resolution = numbersOf("resolution", text, 1, 1)[0];
  if (*options.resolution <= 0.0)
    throw InputError("--resolution must be a positive number of metres, got " + text);
  return options;
}

void describeMap(po::options_description& known) {
  known.add_options()(
      "map", po::value<std::string>()->required(),
      "map_server YAML, MovingAI .map, image, drawing (vector_map YAML), rectangles, rostopic echo "
      "dump or bag")("topic", po::value<std::string>(),
                     "of the map in a bag; default projected_map, or the only one");
}

void describeReading(po::options_description& known) {
  known.add_options()(
      "otsu",
      "an image without a YAML: free and occupied by the threshold that separates dark "
      "and bright best")(
      "columns", po::value<std::string>(),
      "an image without a YAML: resampled to so many columns, rows in proportion");
}

void describePlannerOptions(po::options_description& known, const PlannerOptions& defaults) {
  for (const OptionDescription& option : describeOptions(defaults)) {
    std::string text = option.description;
    if (!option.unit.empty()) text += " [" + option.unit + "]";
    std::string choices;
    for (const std::string& choice : option.choices)
      choices += (choices.empty() ? "" : ", ") + choice;
    if (!choices.empty()) text += " (" + choices + ")";
    text += "; default " + option.value;
    known.add_options()(flagOf(option.name).c_str(), po::value<std::string>(), text.c_str());
  }
  known.add_options()("weights", po::value<std::string>(),
                      "weights of free, unknown and occupied cells as F,U,O")(
      "config", po::value<std::string>(),
      "YAML with parameters of the node path_planner, used where the command line gives no other")(
      "vehicle", po::value<std::string>(),
      "description of the vehicle (YAML, doc/vehicle.md): its outline and turning radius");
}

PlannerOptions plannerOptionsFrom(const po::variables_map& values, const PlannerOptions& defaults) {
  PlannerOptions options = defaults;
  if (values.count("config") != 0) readNodeConfig(values["config"].as<std::string>(), options);
  if (values.count("weights") != 0) {
    const std::string text = values["weights"].as<std::string>();
    const std::vector<double> weights = numbersOf("weights", text, 3, 3);
    for (const double weight : weights)
      if (weight != std::floor(weight) || weight < 1 || weight > 65535)
        throw InputError("--weights must be whole numbers from 1 to 65535, got '" + text + "'");
    options.costmap.free_weight = static_cast<int>(weights[0]);
    options.costmap.unknown_weight = static_cast<int>(weights[1]);
    options.costmap.occupied_weight = static_cast<int>(weights[2]);
  }
  visitOptions(options, FromText{values});
  if (values.count("vehicle") != 0)
    takeFromVehicle(options, vehicle::readDescription(values["vehicle"].as<std::string>()));
  checkPlannerOptions(options);
  return options;
}

void warnAboutUnusedOption(const std::string& option, const std::string& with) {
  std::cerr << "warning: --" << flagOf(option) << " changes nothing with " << with << '\n';
}

void warnAboutUnusedOptions(const PlannerOptions& options, const PlannerOptions& defaults) {
  for (const UnusedOption& unused : unusedOptions(options, defaults))
    warnAboutUnusedOption(unused.name, unused.with);
}

}  // namespace grid_path_planner::command_line
