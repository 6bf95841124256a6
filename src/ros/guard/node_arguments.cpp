#include "ros/guard/node_arguments.h"

#include <ros/init.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {
namespace {

constexpr int kWrongUsage = 2;
constexpr char kSaveFolder[] = "--save-folder";
constexpr char kLoadFolder[] = "--load-folder";

std::string argumentOf(const FileArgument& file) {
  std::string text = "--" + file.option;
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

std::string usageOf(const std::string& name,
                    const std::optional<std::vector<FileArgument>>& files) {
  std::string usage = "usage: " + name;
  for (const FileArgument& file : files.value_or(std::vector<FileArgument>()))
    usage += " [" + (file.without_option ? "[" + argumentOf(file) + "]" : argumentOf(file)) + " " +
             file.value + "]";
  if (files) usage += std::string(" [") + kSaveFolder + " FOLDER] [" + kLoadFolder + " FOLDER]";
  return usage +
         " [_parameter:=value]... [topic:=other_topic]...\n"
         "Parameters, topics and services: doc/nodes.md of grid_path_planner.\n";
}

class Reader {
 public:
  explicit Reader(const std::optional<std::vector<FileArgument>>& files)
      : files_(files.value_or(std::vector<FileArgument>())), has_folders_(files.has_value()) {}

  // Throws std::invalid_argument with a sentence.
  NodeArguments read(const ros::V_string& arguments) {
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      const std::string& argument = arguments[i];
      const std::string option = optionOf(argument);
      if (option.empty()) throw std::invalid_argument("what is '" + argument + "'?");
      const bool named = argument.substr(0, 2) == "--";
      const std::size_t equals = named ? argument.find('=') : std::string::npos;
      if (!named)
        set(option, argument);
      else if (equals != std::string::npos)
        set(option, argument.substr(equals + 1));
      else if (i + 1 < arguments.size())
        set(option, arguments[++i]);
      else
        throw std::invalid_argument("'" + argument + "' needs a value");
    }
    return given_;
  }

 private:
  // The option that `argument` is for, the first that may be given so; "" for none.
  std::string optionOf(const std::string& argument) const {
    const std::string written = argument.substr(0, argument.find('='));
    const bool plain = argument.empty() || argument[0] != '-';
    if (has_folders_ && (written == kSaveFolder || written == kLoadFolder)) return written;
    for (const FileArgument& file : files_)
      if (plain ? file.without_option && !argument.empty() : written == argumentOf(file))
        return file.option;
    return "";
  }

  // An empty value stands for none, so that a launch file may pass what it was not given.
  void set(const std::string& option, const std::string& value) {
    std::string& place = option == kSaveFolder   ? given_.save_folder
                         : option == kLoadFolder ? given_.load_folder
                                                 : given_.files[option];
    if (!place.empty())
      throw std::invalid_argument("what is '" + value + "'? There is one already");
    place = value;
    if (value.empty()) given_.files.erase(option);
  }

  const std::vector<FileArgument> files_;
  const bool has_folders_;
  NodeArguments given_;
};

}  // namespace

void checkCanBeOpened(const std::string& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (in.get() != std::ifstream::traits_type::eof()) return;
  throw base::InputError(
      file, errno == 0 ? "is empty" : std::string("cannot be read: ") + std::strerror(errno));
}

void checkGivenFiles(const std::vector<FileArgument>& known,
                     const std::map<std::string, std::string>& given) {
  for (const FileArgument& argument : known) {
    const auto file = given.find(argument.option);
    if (argument.check && file != given.end()) argument.check(file->second);
  }
}

NodeArguments nodeArguments(int argc, const char* const* argv, const std::string& name,
                            const std::optional<std::vector<FileArgument>>& files) {
  ros::V_string arguments;
  ros::removeROSArgs(argc, argv, arguments);
  const std::string usage = usageOf(name, files);
  NodeArguments ended;
  for (const char* help : {"--help", "-h"})
    if (std::find(arguments.begin() + 1, arguments.end(), help) != arguments.end()) {
      std::cout << usage;
      ended.exit_code = 0;
      return ended;
    }
  try {
    return Reader(files).read(arguments);
  } catch (const std::invalid_argument& error) {
    std::cerr << name << ": " << error.what() << " Parameters are given as _parameter:=value\n"
              << usage;
    ended.exit_code = kWrongUsage;
    return ended;
  }
}

}  // namespace grid_path_planner::nodes
