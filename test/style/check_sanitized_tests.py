"""What sanitizers find is told: scripts/sanitized_tests fails for a report of a process whose end no test sees, for a
failed test and for one that hangs, and its table says which it was.

A program with one fault of each kind is compiled with the sanitizers and is all the tests of a build folder.
"""
import os
import subprocess
import sys
import tempfile

from common import ROOT, finish

# As a test it starts itself again, as a rostest does its nodes, and does not ask how that ended.
PROGRAM = """
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>
volatile int shared = 0;
std::atomic<bool> written{false};
int beyond(int index) {
  int numbers[4] = {};
  volatile int* first = numbers;
  return first[index];
}
int main(int count, char** words) {
  const std::string fault = words[count - 1];
  if (count == 2) return std::system((std::string(words[0]) + " child " + fault).c_str()) == -1;
  if (fault == "overflow") return beyond(count + 1);
  if (fault == "undefined") shared = 2147483647 + count;
  if (fault == "leak") new int;
  if (fault == "race") {
    std::thread other([] {
      while (!written.load(std::memory_order_relaxed)) std::this_thread::yield();
      shared = 1;
    });
    shared = 2;
    written.store(true, std::memory_order_relaxed);  // one after the other: of two at the same moment it may see none
    other.join();
  }
}
"""
TESTS = """
add_test(_ctest_grid_path_planner_gtest_grid_path_planner_found {program} {fault})
set_tests_properties(_ctest_grid_path_planner_gtest_grid_path_planner_found PROPERTIES WORKING_DIRECTORY {folder})
"""
# The first is to run alone, when the second has ended.
IN_TURN = """
add_test(_ctest_grid_path_planner_gtest_grid_path_planner_alone /usr/bin/test -e {folder}/ended)
add_test(_ctest_grid_path_planner_gtest_grid_path_planner_other /bin/sh -c "sleep 1; touch {folder}/ended")
set_tests_properties(_ctest_grid_path_planner_gtest_grid_path_planner_alone PROPERTIES WORKING_DIRECTORY {folder} RUN_SERIAL ON)
set_tests_properties(_ctest_grid_path_planner_gtest_grid_path_planner_other PROPERTIES WORKING_DIRECTORY {folder})
"""
FLAGS = {"address": "-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all",
         "thread": "-fsanitize=thread"}


def answer(folder):
    return subprocess.run([sys.executable, os.path.join(ROOT, "scripts/sanitized_tests"), folder], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True, check=False)


def build(folder, tool):
    program = os.path.join(folder, "program")
    with open(program + ".cpp", "w", encoding="utf-8") as file:
        file.write(PROGRAM)
    with open(os.path.join(folder, "CMakeCache.txt"), "w", encoding="utf-8") as file:
        file.write("CMAKE_CXX_FLAGS:STRING=%s\n" % FLAGS[tool])
    sources = [program + ".cpp", os.path.join(ROOT, "test/undefined_behaviour_reports.cpp")]
    subprocess.run(["c++", "-O0", "-g1", *FLAGS[tool].split(), *sources, "-o", program, "-pthread", "-ldl"], check=True)


def told(folder, test):
    """The exit code and the row of the only test, which these lines of CTestTestfile.cmake are."""
    with open(os.path.join(folder, "CTestTestfile.cmake"), "w", encoding="utf-8") as file:
        file.write(test)
    said = answer(folder)
    rows = [line.split()[:4] for line in said.stdout.splitlines() if line.startswith("found ")]
    return said.returncode, *rows


def complaints_with(folder, tool, faults):
    build(folder, tool)
    program = os.path.join(folder, "program")
    cases = {fault: (program, "passed", "0" if fault == "sound" else "1") for fault in ("sound", *faults)}
    cases.update({"failed": ("/bin/false", "FAILED", "0")})
    for fault, (command, result, reports) in cases.items():
        test = TESTS.format(program=command, fault=fault, folder=folder)
        wanted = (0 if fault == "sound" else 1, ["found", tool, result, reports])
        found = told(folder, test)
        if found != wanted:
            yield "of %s with the %s sanitizer it says %s, not %s" % (fault, tool, found, wanted)
    hangs = TESTS.format(program="/bin/sleep", fault=1000, folder=folder).replace("PROPERTIES", "PROPERTIES TIMEOUT 1")
    if told(folder, hangs) != (1, ["found", tool, "TIMEOUT", "0"]):
        yield "of one that hangs it says %s" % (told(folder, hangs),)
    if told(folder, IN_TURN.format(folder=folder)) != (0,):
        yield "one that is to run alone does not"
    if told(folder, "") != (2,):
        yield "of no test it says %s" % (told(folder, ""),)


def main():
    complaints = []
    for tool, faults in (("address", ("overflow", "undefined", "leak")), ("thread", ("race",))):
        with tempfile.TemporaryDirectory() as folder:
            complaints += complaints_with(folder, tool, faults)
    finish(complaints, "2 sanitizers")


main()
