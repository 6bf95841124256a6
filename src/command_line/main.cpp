// grid_path: plans and measures without a roscore.
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "command_line/commands.h"
#include "grid_path_planner/base/option_text.h"

namespace {

using grid_path_planner::command_line::Command, grid_path_planner::command_line::commands,
    grid_path_planner::command_line::kBadInput;

constexpr std::size_t kNameWidth = 14;  // with the gap after the longest name

int usage(std::ostream& out, int code) {
  out << "usage: grid_path COMMAND [options]\n\n";
  for (const Command& command : commands())
    out << "  " << command.name << std::string(kNameWidth - std::strlen(command.name), ' ')
        << command.purpose << '\n';
  out << "\n'grid_path COMMAND --help' lists a command's options, 'grid_path --version' prints the "
         "version.\n";
  return code;
}

std::string closestCommand(const std::string& name) {
  std::vector<std::string> known;
  for (const Command& command : commands()) known.emplace_back(command.name);
  return grid_path_planner::base::closestName(name, known);
}

int runNamed(const Command& command, int argc, char** argv) {
  try {
    return command.run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "grid_path " << command.name << ": " << error.what() << '\n';
    return kBadInput;
  }
}

int run(int argc, char** argv) {
  if (argc < 2) return usage(std::cerr, kBadInput);
  const std::string name = argv[1];
  if (name == "--version") {
    std::cout << "grid_path " << GPP_VERSION << '\n';
    return 0;
  }
  if (name == "--help" || name == "-h" || name == "help") return usage(std::cout, 0);
  for (const Command& command : commands())
    if (name == command.name) return runNamed(command, argc - 1, argv + 1);
  const std::string meant = closestCommand(name);
  std::cerr << "grid_path: there is no command '" << name << "'"
            << (meant.empty() ? "" : "; did you mean " + meant + "?") << "\n\n";
  return usage(std::cerr, kBadInput);
}

// It may go to a file, on a disk that is full.
bool isAllPrinted() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run(argc, argv);
  if (isAllPrinted()) return code;
  std::cerr << "grid_path: not all that was printed could be written\n";
  return code == 0 ? kBadInput : code;
}
