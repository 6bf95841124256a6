"""The checks see what they are there for: each finds nothing in a good tree and what is planted."""
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
HEADER = "// What it is for.\n#pragma once\n%s\nnamespace grid_path_planner {}\n"
FLOORS = "gpp_add_room(base)\ngpp_add_room(grid ROOMS base LIBRARIES x)\ngpp_add_room(ros ROOMS grid)\n"


def complaints(check, name=None, text=None):
    """What a check says of a good tree into which one file is planted."""
    with tempfile.TemporaryDirectory() as root:
        tree = {"CMakeLists.txt": FLOORS,
                "include/grid_path_planner/base/errors.h": HEADER % "#include <string>",
                "include/grid_path_planner/grid/cell.h":
                    HEADER % '#include "grid_path_planner/base/errors.h"',
                "src/ros/node.cpp": "#include <ros/ros.h>\nnamespace grid_path_planner {}\n"}
        if name:
            tree[name] = text
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


class Includes(unittest.TestCase):
    def planted(self, room, include):
        return complaints("check_includes.py", "src/%s/x.cpp" % room,
                          "#include <vector>\n#include %s\nnamespace grid_path_planner {}\n" % include)

    def test_good_ones_are_left_alone(self):
        self.assertEqual(complaints("check_includes.py"), [])
        self.assertEqual(self.planted("grid", '"grid_path_planner/base/errors.h"'), [])
        self.assertEqual(self.planted("tools", '"grid_path_planner/ros/node.h"'), [])

    def test_upwards(self):
        self.assertEqual(self.planted("base", '"grid_path_planner/grid/cell.h"'),
                         ["src/base/x.cpp:2: room 'base' stands not on 'grid'"])
        self.assertEqual(len(self.planted("grid", '<grid_path_planner/ros/node.h>')), 1)

    def test_ros_below_its_floor(self):
        for header in ("<ros/ros.h>", "<nav_msgs/Path.h>", "<tf2_ros/buffer.h>",
                       "<grid_path_planner/PlanStatistics.h>"):
            self.assertEqual(len(self.planted("grid", header)), 1, header)
            self.assertEqual(self.planted("ros", header), [], header)

    def test_other_folders_and_rooms(self):
        self.assertEqual(len(self.planted("grid", '"../base/private.h"')), 1)
        self.assertEqual(len(self.planted("cellar", "<string>")), 1)


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


unittest.main()
