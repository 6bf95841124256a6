// A program of the fuzzer: libFuzzer's own arguments, and first of all
//
//   --target=NAME             what is fuzzed
//   --write-seeds=FOLDER      writes the target's seeds and ends
//   --list                    prints the targets and ends
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

const FuzzTarget* chosen = nullptr;

// The value of the argument "--NAME=VALUE"; empty where there is none.
std::string argumentOf(int argc, char** argv, const std::string& name) {
  const std::string beginning = "--" + name + "=";
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]).compare(0, beginning.size(), beginning) == 0)
      return std::string(argv[i]).substr(beginning.size());
  return "";
}

void writeSeeds(const std::string& folder) {
  int number = 0;
  for (const std::string& seed : chosen->seeds())
    std::ofstream(folder + "/seed" + std::to_string(number++), std::ios::binary) << seed;
}

[[noreturn]] void listTargets() {
  for (const FuzzTarget& target : fuzzTargets()) std::puts(target.name.c_str());
  std::exit(EXIT_SUCCESS);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc > 1 && std::string((*argv)[1]) == "--list") listTargets();
  const std::string name = argumentOf(*argc, *argv, "target");
  for (const FuzzTarget& target : fuzzTargets())
    if (target.name == name) chosen = &target;
  if (!chosen) {
    std::fprintf(stderr, "there is no target '%s'\n", name.c_str());
    std::exit(EXIT_FAILURE);
  }
  const std::string folder = argumentOf(*argc, *argv, "write-seeds");
  if (folder.empty()) return 0;
  writeSeeds(folder);
  std::exit(EXIT_SUCCESS);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->run(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

}  // namespace grid_path_planner::fuzz
