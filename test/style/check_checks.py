"""The checks see what they are there for: each finds nothing in a good tree and what is planted."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
with open("/etc/os-release", encoding="utf-8") as release:
    UBUNTU_2004 = "UBUNTU_CODENAME=focal" in release.read()
HEADER = "// What it is for.\n#pragma once\n%s\nnamespace grid_path_planner {}\n"
FLOORS = {"base": "gpp_add_room(base)", "grid": "gpp_add_room(grid ROOMS base LIBRARIES x)",
          "planners": "gpp_add_room(planners ROOMS grid)",
          "ros/guard": "gpp_add_room(ros_guard FOLDER ros/guard ROOMS grid)"}


def complaints(check, name=None, text=None, more=()):
    """What a check says of a good tree, with `more` files, into which one file is planted."""
    with tempfile.TemporaryDirectory() as root:
        tree = {"src/%s/CMakeLists.txt" % folder: line for folder, line in FLOORS.items()}
        tree.update({
            "CMakeLists.txt": "project(package)\n",
            "include/grid_path_planner/base/errors.h": HEADER % "#include <string>",
            "include/grid_path_planner/grid/cell.h":
                    HEADER % '#include "grid_path_planner/base/errors.h"',
            "src/ros/guard/node.cpp": "#include <ros/ros.h>\nnamespace grid_path_planner {}\n",
            "src/grid/halved.cpp": "namespace grid_path_planner {\nint halved(int all) {\n"
                                       "  return all / 2;\n}\n}\n",
            "include/grid_path_planner/base/stop_token.h":
                    "// When to stop.\n//\n//   StopToken token;\n//   use(token);\n"
                    "#pragma once\nnamespace grid_path_planner { class StopToken {}; }\n",
            "build/compile_commands.json": json.dumps([{"command": "g++ -Iinclude -std=c++17"}])})
        if name:
            tree[name] = text
        tree.update(more)
        for file, content in tree.items():
            path = os.path.join(root, file)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as out:
                out.write(content)
        answer = subprocess.run([sys.executable, os.path.join(HERE, check)], check=False,
                                env=dict(os.environ, STYLE_ROOT=root), capture_output=True, text=True)
        lines = answer.stdout.splitlines()[:-1]
        assert answer.returncode == (1 if lines else 0), answer
        return lines


class Tools(unittest.TestCase):
    def test_a_check_without_its_tool_fails_and_names_the_package(self):
        for check, package in (("api_pages", "doxygen"), ("house", "universal-ctags"), ("catkin_lint", "catkin-lint"),
                               ("format", "clang-format-14"), ("scripts", "shellcheck")):
            answer = subprocess.run([sys.executable, os.path.join(HERE, "check_%s.py" % check)], check=False,
                                    env=dict(os.environ, PATH=""), capture_output=True, text=True)
            self.assertEqual(answer.returncode, 1, check)
            self.assertIn("apt-get install %s;" % package, answer.stderr)

    def test_a_check_without_a_build_fails(self):
        for check in ("examples", "headers", "precompiled_headers"):
            answer = subprocess.run([sys.executable, os.path.join(HERE, "check_%s.py" % check), "absent"],
                                    check=False, capture_output=True, text=True)
            self.assertEqual(answer.returncode, 1, check)
            self.assertIn("scripts/build makes it", answer.stderr)


class Includes(unittest.TestCase):
    def planted(self, room, include):
        return complaints("check_includes.py", "src/%s/x.cpp" % room,
                          "#include <vector>\n#include %s\nnamespace grid_path_planner {}\n" % include)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(complaints("check_includes.py"), [])
        self.assertEqual(self.planted("grid", '"grid_path_planner/base/errors.h"'), [])
        self.assertEqual(self.planted("command_line", '"grid_path_planner/grid/cell.h"'), [])

    def test_upwards(self):
        self.assertEqual(self.planted("base", '"grid_path_planner/grid/cell.h"'),
                         ["src/base/x.cpp:2: room 'base' stands not on 'grid'"])
        self.assertEqual(len(self.planted("grid", '<grid_path_planner/planners/planner.h>')), 1)

    def test_folders_of_planners(self):
        core, astar = {"src/planners/core/queue.h": HEADER % ""}, {"src/planners/astar/search.h": HEADER % ""}
        upwards = '#include "planners/astar/search.h"\nnamespace grid_path_planner {}\n'
        self.assertEqual(complaints("check_includes.py", "src/planners/core/x.cpp", upwards, astar),
                         ["src/planners/core/x.cpp:1: planners/core stands not on planners/astar"])
        downwards = upwards.replace("astar/search", "core/queue")
        self.assertEqual(complaints("check_includes.py", "src/planners/astar/x.cpp", downwards, core), [])

    def test_private_headers(self):
        private = {"src/base/clock.h": HEADER % ""}
        source = '#include "base/clock.h"\nnamespace grid_path_planner {}\n'
        self.assertEqual(complaints("check_includes.py", "src/base/x.cpp", source, private), [])
        self.assertEqual(complaints("check_includes.py", "src/grid/x.cpp", source, private),
                         ["src/grid/x.cpp:1: 'base/clock.h' is a private header of 'base'"])

    def test_lent_headers(self):
        lent = {"src/base/zeroed_array.h": HEADER % ""}
        source = '#include "base/zeroed_array.h"\nnamespace grid_path_planner {}\n'
        self.assertEqual(complaints("check_includes.py", "src/planners/x.cpp", source, lent), [])
        self.assertEqual(complaints("check_includes.py", "src/grid/x.cpp", source, lent),
                         ["src/grid/x.cpp:1: 'base/zeroed_array.h' is a private header of 'base'"])

    def test_ros_below_its_floor(self):
        for header in ("<ros/ros.h>", "<nav_msgs/Path.h>", "<tf2_ros/buffer.h>", "<grid_path_planner/PlanStatistics.h>"):
            self.assertEqual(len(self.planted("grid", header)), 1, header)
            self.assertEqual(self.planted("ros/guard", header), [], header)

    def test_other_folders_rooms_and_hashes_of_sources(self):
        hashed = {"src/grid/CMakeLists.txt": FLOORS["grid"] + "\ngpp_add_sources_hash(grid grid)"}  # and base
        self.assertEqual(len(complaints("check_includes.py", more=hashed)), 1)
        self.assertEqual(len(self.planted("grid", '"../base/private.h"')), 1)
        self.assertEqual(len(self.planted("cellar", "<string>")), 1)


class Docs(unittest.TestCase):
    TREE = {"README.md": "# Package\n[nodes](doc/nodes.md#the-planner), [needs](doc/dependencies.md), [rooms](doc/architecture.md)\n"
                         "<!-- parameters: planner -->\n<!-- end -->\n<!-- launch files -->\n%s<!-- end -->\n",
            "doc/nodes.md": "# Nodes\n## The planner\n`FOUND`\n    # no-heading\ngrid_path_planner/Plan `./scripts/run --fast`\n",
            "doc/architecture.md": "# Rooms\n`grid/` `guard/` `nodes/` `src/nodes/planner.cpp` `src/nodes/x.cpp`\n",
            "doc/dependencies.md": "# Dependencies\n| Boost | |\n",
            "package.xml": "<package><depend>libboost-dev</depend></package>",
            "msg/Plan.msg": "", "scripts/run": "--fast", "src/nodes/planner.cpp": "",
            "launch/planner.launch": "<launch><arg name='map'/></launch>",
            "include/grid_path_planner/base/status.h": "enum class Status { FOUND };"}
    TABLE = "| launch file | argument | default |  |\n|---|---|---|---|\n| `planner.launch` | `map` | required |  |\n"

    def planted(self, name=None, text=None):
        tree = dict(self.TREE)
        tree["README.md"] %= self.TABLE
        if name:
            tree[name] = text.replace("<README>", tree["README.md"])
        return complaints("check_docs.py", more=tree)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted(), [])

    def test_tables_and_length(self):
        self.assertEqual(self.planted("launch/planner.launch", "<launch><arg name='goal'/></launch>"),
                         ["README.md: the table of launch files is out of date: test/style/check_docs.py --write"])
        self.assertEqual(self.planted("README.md", "<README>" + "\n" * 165), ["README.md: 174 lines are more than 165"])

    def test_names(self):
        for name, text in (("src/nodes/simulator.cpp", ""), ("msg/Goal.msg", ""), ("scripts/walk", ""),
                           ("include/grid_path_planner/base/status.h", "enum class Status { FOUND, LOST };"),
                           ("package.xml", "<package><depend>octomap</depend></package>")):
            self.assertEqual(len(self.planted(name, text)), 1, name)

    def test_links(self):
        for link in ("doc/absent.md", "doc/nodes.md#no-heading", "#absent", "scripts/run#x"):
            self.assertEqual(len(self.planted("README.md", "<README>[x](%s)\n" % link)), 1, link)
        self.assertEqual(self.planted("README.md", "<README>[x](https://example.org/#y) [y](#package)\n"), [])
        self.assertEqual(self.planted("doc/lost.md", "# Lost\n"), ["doc/lost.md: no link leads here from README.md"])

    def test_places(self):
        for text in ("nodes/absent.cpp", "absent/", "src/x/"):
            self.assertEqual(len(self.planted("doc/architecture.md", "`grid/` `guard/` `nodes/` `%s`\n" % text)), 1, text)
        self.assertEqual(self.planted("src/cellar/a.cpp", ""), ["doc/architecture.md: src/cellar is missing"])

    def test_counterparts(self):
        def page(row):
            tree = dict(self.TREE, **{"src/grid/halved.cpp": 'visit("radius"); serve("~reset");\n',
                                      "doc/nav2.md": "| nav2 | here |\n|---|---|\n" + row})
            tree["README.md"] = tree["README.md"] % self.TABLE + "[nav2](doc/nav2.md)\n"
            return complaints("check_docs.py", more=tree)
        self.assertEqual(page("| **Layers** | |\n| static layer | `planner` |\n"), [])
        self.assertEqual(page("| inflation | `radius`, `radius: 0.4`, `~reset`, `FOUND`; no: `x.y` is theirs |\n"),
                         ["doc/nav2.md: there is no `x.y`, which stands for 'inflation'"])
        self.assertEqual(page("| **Layers** | |\n| denoise layer | |\n"), ["doc/nav2.md: what is here for 'denoise layer'?"])

    def test_scripts(self):
        self.assertEqual(len(self.planted("README.md", "<README>./scripts/run --slow\n")), 1)
        self.assertEqual(len(self.planted("README.md", "<README>scripts/jump\n")), 1)


class Files(unittest.TestCase):
    def planted(self, text, name="include/grid_path_planner/grid/x.h"):
        return complaints("check_files.py", name, text)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(complaints("check_files.py"), [])
        self.assertEqual(self.planted(HEADER % ""), [])
        self.assertEqual(self.planted("int main() {}\n", "src/nodes/x.cpp"), [])

    def test_headers(self):
        for text in (HEADER % "#pragma once", (HEADER % "").replace("#pragma once\n", ""),
                     HEADER % "using namespace std;", (HEADER % "").replace("// What", "\n// What"),
                     (HEADER % "").replace("grid_path_planner", "planner"),
                     HEADER % "// TODO: more"):
            self.assertEqual(len(self.planted(text)), 1, text)

    def test_names(self):
        for name in ("a_star_v2.h", "a_star_new.h", "AStar.h", "a_star_2.h", "a-star.h"):
            name = "include/grid_path_planner/grid/" + name
            self.assertEqual(len(self.planted(HEADER % "", name)), 1, name)

    def test_nodes_take_neither_timers_nor_throttled_lines_from_roscpp(self):
        for text in ("timer_ = nh_.createWallTimer(period, tick);\n", 'ROS_WARN_STREAM_THROTTLE(1.0, "late");\n'):
            source = (HEADER % "").replace("#pragma once\n", "") + text
            self.assertEqual(len(self.planted(source, "src/ros/driving/x.cpp")), 1)
            self.assertEqual(self.planted(source, "test/ros/x_rostest.cpp"), [])

    def test_a_benchmark_says_what_lies_beyond_its_map(self):
        radius, outside = "  options.radius = 0.3;\n", "  options.outside = Outside::FREE;\n"
        self.assertEqual(self.planted(radius + outside, "benchmark/x.cpp"), [])
        self.assertEqual(len(self.planted(radius, "benchmark/x.cpp")), 1)
        self.assertEqual(len(self.planted('{"/path_planner/radius": 0.3}', "benchmark/x.py")), 1)


@unittest.skipIf(UBUNTU_2004, "its Doxygen is too old")
class ApiPages(unittest.TestCase):
    def planted(self, text):
        return complaints("check_api_pages.py", "include/grid_path_planner/grid/x.h", text)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted(
            "// Of <x> & y@z: \\n, 50 %n, #1.\n//\n//   Grid<int> grid;  // any\n#pragma once\n"
            "// Costs `a<b>`.\nvoid f(int a,  // <a>\n       int b); // b\n"), [])

    def test_an_essay_that_is_lost(self):
        self.assertEqual(len(self.planted("/* Of x. */\n#pragma once\nvoid f();\n")), 1)

    def test_warnings(self):
        self.assertNotEqual(self.planted("// Of x.\n#pragma once\n/** @nonsense */\nvoid f();\n"), [])


@unittest.skipIf(UBUNTU_2004, "its catkin_lint is another one")
class CatkinLint(unittest.TestCase):
    def test_a_dependency_that_is_not_found(self):
        package = ("<package format=\"2\"><name>package</name><version>0.1.0</version><description>x</description>"
                   "<maintainer email=\"a@b.de\">a</maintainer><license>BSD</license>"
                   "<buildtool_depend>catkin</buildtool_depend><depend>roscpp</depend></package>")
        cmake = ("cmake_minimum_required(VERSION 3.16)\nproject(package)\nfind_package(catkin REQUIRED)\n"
                 "catkin_package()\n")
        found = complaints("check_catkin_lint.py", "package.xml", package, {"CMakeLists.txt": cmake})
        self.assertTrue(any("roscpp" in line for line in found), found)


class Headers(unittest.TestCase):
    def planted(self, text, more=()):
        name = "include/grid_path_planner/grid/x.h"
        return [line.split(": error:")[0].rsplit(":", 1)[0] if ": error:" in line else line
                for line in complaints("check_headers.py", name, HEADER % text, more)]

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted('#include "grid_path_planner/grid/cell.h"\nstd::string f();'), [])
        self.assertEqual(self.planted("#include <grid_path_planner/PlanStatistics.h>", {
            "src/grid/x.cpp": '#include "grid_path_planner/grid/x.h"\n'}), [])

    def test_private_headers(self):
        private = {"src/grid/own.h": "#pragma once\n", "src/grid/x.cpp": '#include "grid_path_planner/grid/x.h"\n'}
        for include in ('"grid/own.h"', "<grid/own.h>", '"own.h"'):
            self.assertEqual(len(self.planted("#include " + include, private)), 1, include)

    def test_a_header_that_needs_another_before_it(self):
        self.assertEqual(self.planted("std::string f();"), ["include/grid_path_planner/grid/x.h:3"])
        first = {"src/grid/x.cpp": '#include "grid_path_planner/grid/x.h"\n'}
        self.assertEqual(self.planted("std::string f();", first), [])  # the build says so
        late = {"src/grid/x.cpp": '#include <string>\n#include "grid_path_planner/grid/x.h"\n'}
        self.assertEqual(len(self.planted("std::string f();", late)), 1)


class Examples(unittest.TestCase):
    def planted(self, essay):
        """The complaints; those of the compiler without their columns and sentences."""
        name = "include/grid_path_planner/grid/x.h"
        header = "// Of x.\n//\n%s#pragma once\nnamespace grid_path_planner::grid {\nvoid f(int);\n}\n"
        found = complaints("check_examples.py", name, header % essay)
        return [line.split(": error:")[0].rsplit(":", 1)[0] if ": error:" in line else line
                for line in found]

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted("//   f(1);  // in the header's namespace\n"), [])
        self.assertEqual(self.planted("//   int n = 2;\n//\n// And then:\n//   f(n);\n"), [])
        self.assertEqual(self.planted("//   template <class T> void g(T t) { f(t); }\n//   void h();\n"),
                         [])

    def test_tables_are_no_code(self):
        self.assertEqual(self.planted("//   topic   what f(1) sends; and when\n//   data: {...}\n"), [])

    def test_code_that_does_not_compile(self):
        header = "include/grid_path_planner/grid/x.h"
        self.assertEqual(self.planted("//   f(1);\n//   f(\"1\");\n"), [header + ":4"])
        self.assertEqual(self.planted("//   f(1, 2);\n"), [header + ":3"])
        self.assertEqual(self.planted("//   unheard(1);\n"), [header + ":3"])

    def test_abbreviations(self):
        self.assertIn("'...' is no code", self.planted("//   f(1);\n//   f(...);\n")[0])
        self.assertIn("without a statement", self.planted("//   f(1)  // sends\n")[0])


class House(unittest.TestCase):
    FILLED = {"%s/filler_%d.h" % (folder, i): "" for i in range(3) for folder in [
        "include/grid_path_planner/base", "include/grid_path_planner/grid"] + ["src/" + floor for floor in FLOORS]}

    def planted(self, text, name="src/grid/x.cpp"):
        return complaints("check_house.py", name, "namespace grid_path_planner {\n%s}\n" % text, self.FILLED)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted("void f() {\n}\n"), [])

    def test_long_functions(self):
        # Half of the functions of so small a tree may not be long either.
        few = "".join("void f%d() {\n}\n" % i for i in range(99))
        self.assertEqual(self.planted(few + "void g() {\n" + "//\n" * 58 + "}\n"), [])
        self.assertEqual(len(self.planted(few + "void g() {\n" + "//\n" * 59 + "}\n")), 1)
        self.assertEqual(len(self.planted("void g() {\n" + "//\n" * 18 + "}\n")), 1)

    def test_large_classes_of_the_nodes(self):
        def of_members(count, kind="class Node"):
            return kind + " {\n" + "".join("  int x%d_;\n" % i for i in range(count)) + "  static int shared_;\n};\n"
        node = "src/ros/guard/x.h"
        self.assertEqual(self.planted(of_members(18), node), [])
        self.assertEqual(self.planted(of_members(19), node), [node + ": Node has 19 members, more than 18"])
        self.assertEqual(len(self.planted(of_members(19, "struct Node"), node)), 1)
        self.assertEqual(self.planted(of_members(19, "struct NodeOptions"), node), [])
        self.assertEqual(self.planted(of_members(19), "src/grid/x.h"), [])

    def test_long_opening_comments(self):
        header = "src/grid/x.h"
        self.assertEqual(complaints("check_house.py", header, "//\n" * 25 + "#pragma once\n", self.FILLED), [])
        self.assertEqual(complaints("check_house.py", header, "//\n" * 26 + "#pragma once\n" + "//\n" * 99, self.FILLED),
                         [header + ":1: " + header + " has 26 lines, more than 25"])

    def test_small_folders(self):
        self.assertEqual(self.planted("", "src/grid/below/x.cpp"),
                         ["src/grid/below: 1 files, fewer than 4: a folder so small has its reason in house_exceptions.py"])
        more = dict(self.FILLED, **{"src/layers/below/x%d.cpp" % i: "" for i in range(4)})
        self.assertEqual(complaints("check_house.py", "src/layers/x.cpp", "", more), [])

    def test_types_twice(self):
        other = "class StopToken { int state; };\n"
        self.assertEqual(self.planted(other),
                         ["grid_path_planner::StopToken is defined in include/grid_path_planner/base/"
                          "stop_token.h and in src/grid/x.cpp"])
        self.assertEqual(self.planted("class StopToken;\n"), [])
        self.assertEqual(self.planted("namespace grid {\n%s}\n" % other), [])
        self.assertEqual(self.planted("namespace {\n%s}\n" % other), [])


class PrecompiledHeaders(unittest.TestCase):
    def planted(self, more):
        """The complaints about a source that is compiled with `more` options than its header."""
        with tempfile.TemporaryDirectory() as folder:
            header = os.path.join(folder, "cmake_pch.hxx")
            with open(header, "w", encoding="utf-8") as file:
                file.write("#ifdef SWITCH\n#endif\n")
            subprocess.run(["g++", "-x", "c++-header", header, "-o", header + ".gch"], check=True)
            command = "g++ %s -Winvalid-pch -include %s -o x.o -c x.cpp" % (more, header)
            entry = {"command": command, "file": "x.cpp", "directory": folder}
            return complaints("check_precompiled_headers.py", "build/compile_commands.json", json.dumps([entry]))

    def test_used(self):
        self.assertEqual(self.planted("-DOTHER"), [])

    def test_rejected(self):
        self.assertIn("`SWITCH' is defined", self.planted("-DSWITCH")[0])

    def test_not_built(self):
        self.assertIn("is not built", self.planted("-include absent/cmake_pch.hxx")[0])


class Words(unittest.TestCase):
    def planted(self, text, name="src/grid/x.cpp"):
        return complaints("check_words.py", name, text)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted("// Always away from the second one: secondary, waypoint, always.\n"
                                      "int waypoints; class Waypoint; class Desktop; MISSED_WAYPOINT\n"
                                      "scale == \"cheapest\"; // 'cheapest' and `cheapest`\n"), [])
        self.assertEqual(self.planted("heuristic_scale: cheapest  # text\n", "config/x.yaml"), [])

    def test_private_words(self):
        for text in ("// the way", "// ways", "goal_tree", "GoalTree", "goalTree", "kGoalTree", "GOAL_TREE",
                     "PlanDesk", "a_desk", "desk_", "dearest()", "dearestOf()", "ONE_WAY", "WAYS", "kWay",
                     "// cheapest", "cheapestOf()"):
            self.assertGreaterEqual(len(self.planted(text + "\n")), 1, text)
        self.assertEqual(self.planted("\n", "src/grid/goal_tree.cpp"),
                         ["src/grid/goal_tree.cpp:0: 'goal_tree': the field says backward search tree"])

    def test_private_words_of_pages(self):
        for name in ("README.md", "doc/x.md", "config/x.yaml", "srv/X.srv"):
            self.assertEqual(self.planted("# one\nthe way\n", name),
                             [name + ":2: 'way': the field says path, direction, method"])


class NoeticCalls(unittest.TestCase):
    def planted(self, text, name):
        return complaints("check_noetic_calls.py", name, text)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(self.planted("cv::imread(file); Eigen::Vector2d v; YAML::Load(text);\n",
                                      "src/grid/x.cpp"), [])
        self.assertEqual(self.planted("if (n := f()) is None:\n    pass\n", "scripts/x.py"), [])

    def test_calls_of_later_libraries(self):
        for text in ("v(Eigen::seq(0, 2));", "m.reshaped();", "cv::hasNonZero(m);", "#include <boost/json.hpp>",
                     "rtcCollide(a, b);", "std::from_chars(a, b, x);", "node.as<std::string_view>();",
                     "root.Model();", "#include <span>"):
            self.assertEqual(len(self.planted("\n" + text + "\n", "src/grid/x.cpp")), 1, text)

    def test_cmake_and_shell(self):
        for text in ("cmake_path(GET x y)", "file(REAL_PATH a b)", "find_program(X x\n REQUIRED)"):
            self.assertEqual(len(self.planted(text + "\n", "cmake/x.cmake")), 1, text)
        self.assertEqual(len(self.planted("#!/bin/sh\nctest --test-dir build\n", "scripts/x")), 1)

    def test_python(self):
        for text in ("match x:\n    case 1:\n        pass", "'a'.removeprefix('b')", "def f(a: list[int]): pass",
                     "def f() -> int | None: pass"):
            self.assertEqual(len(self.planted(text + "\n", "scripts/x.py")), 1, text)


unittest.main()
