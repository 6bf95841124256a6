"""C++ files are built alike: a header opens with what it is for, has one #pragma once, and everything
lives in the package's namespace. Names carry no versions, and nothing is left to be done later. A benchmark
that sets a radius says what lies beyond its map. Timers of nodes outlive an exception."""
import re

from common import files, finish, read

NAME = re.compile(r"[a-z][a-z0-9_]*\.(h|cpp)$")
VERSION = re.compile(r"(^|_)(v?\d+|new|old|final|copy|backup|tmp|fixed|improved|refactored)$")
UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")
NAMESPACE = re.compile(r"^namespace grid_path_planner(::\w+)? \{", re.MULTILINE)
RADIUS = re.compile(r'\.radius = |planner/radius"')
OUTSIDE = re.compile(r'\.outside = |planner/outside"')
TIMER = re.compile(r"(?:\.|->)create(?:Wall|Steady)?Timer\(")
TIMERS = ("src/ros/guard/scheduling/guarded_timer.cpp", "src/ros/guard/action/action_topics.h")  # the latter's never starts
THROTTLE = re.compile(r"ROS_\w+_THROTTLE\(")
MAIN = re.compile(r"^int main\(", re.MULTILINE)


def complaints_of(name, text):
    base = name.split("/")[-1]
    lines = text.splitlines()
    if not NAME.match(base):
        yield "the name is not under_scored"
    if VERSION.search(base.rsplit(".", 1)[0]):
        yield "the name carries a version"
    if UNFINISHED.search(text):
        yield "something is left to be done: " + UNFINISHED.search(text).group(0)
    if not NAMESPACE.search(text) and not MAIN.search(text):
        yield "no namespace grid_path_planner"
    if name.startswith("src/") and name not in TIMERS and TIMER.search(text):
        yield "a timer of roscpp's, which an exception ends for good: guarded_timer.h"
    if name.startswith("src/") and THROTTLE.search(text):
        yield "a line of the log whose time is in no lock: log_throttle.h"
    if base.endswith(".cpp"):
        if "#pragma once" in text:
            yield "#pragma once in a source file"
        return
    if lines.count("#pragma once") != 1:
        yield "a header has #pragma once exactly once"
    if not lines or not lines[0].startswith("// "):
        yield "a header opens with what it is for"
    if re.search(r"^using namespace ", text, re.MULTILINE):
        yield "using namespace in a header"


def complaints_of_benchmark(text):
    if RADIUS.search(text) and not OUTSIDE.search(text):
        yield "sets a radius and not outside, by which paths keep it from the map's border or not"


def main():
    names = files(("include", "src", "test"), (".h", ".cpp"))
    benchmarks = files(("benchmark",), "")
    finish(["%s: %s" % (name, complaint)
            for name in names for complaint in complaints_of(name, read(name))] +
           ["%s: %s" % (name, complaint)
            for name in benchmarks for complaint in complaints_of_benchmark(read(name))],
           "%d files" % len(names + benchmarks))


main()
