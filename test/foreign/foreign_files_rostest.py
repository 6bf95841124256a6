#!/usr/bin/env python3
"""Files of other programs, to every command and node that reads them: maps to grid_path plan and map_publisher, waypoints to
grid_path waypoints, octrees to grid_path project and projected_map.

`expect` has sees (room; unknown: all but the wall), told and refused as foreign_maps_rostest.py, or waypoints: both, or utm; clearance, m to the
unknown cells of all but the path's first segment, as ask.arguments say; occupied and unknown, how many cells.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import foreign_files
import foreign_nodes
import rooms
import rospy
import rostest
import table
import yaml
from foreign_nodes import ForeignTest, Row, wait_until
from running_nodes import executable

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "foreign")
PLAN = ["--smooth", "false", "--outside", "free", "--unknown-is-passable", "false", "--json",
        "--start", "%r,%r" % rooms.START, "--goal", "%r,%r" % rooms.GOAL]


def run(*arguments):
    return subprocess.run([executable("grid_path")] + list(arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True)


class Files(ForeignTest):
    kind = "map_files"

    def folder_of(self, row):
        name = os.path.join(self.folder.name, row["id"])
        os.makedirs(name, exist_ok=True)
        return name

    def test_maps_of_plan(self):
        self.each("plan", self.planned)

    def planned(self, row, expect):
        asked = row.get("ask", {}).get("arguments", [])
        done = run("plan", "--map", foreign_files.map_file(row, self.folder_of(row)), *(asked + PLAN[:7] if asked else PLAN))
        if expect.get("sees") == "unknown":
            return "" if done.returncode == 1 and "unknown cell" in done.stdout else done.stderr + done.stdout
        if "refused" in expect:
            return "" if done.returncode == 2 and re.search(expect["refused"], done.stderr) else done.stderr + done.stdout
        if done.returncode != 0:
            return done.stderr + done.stdout
        if not re.search(expect.get("told", ""), done.stderr):
            return "it does not say %s" % expect["told"]
        if "clearance" in expect:
            return self.too_near(json.loads(done.stdout)["path"][1:], expect["clearance"])
        length = json.loads(done.stdout)["length_m"]
        return "" if abs(length - rooms.AROUND) < 1e-9 else "%.9f m" % length

    @staticmethod
    def too_near(path, clearance):
        """Of what is on straight lines between those places."""
        places = [(a[0] + step / 1000 * (b[0] - a[0]), a[1] + step / 1000 * (b[1] - a[1]))
                  for a, b in zip(path, path[1:]) for step in range(1001)]
        least = min(math.hypot(*(max(0.05 * side - at, 0.0, at - 0.05 * (side + 1)) for side, at in zip(cell, place)))
                    for place in places for cell in foreign_files.UNKNOWN)
        return "" if least >= clearance - 1e-9 else "%.4f m" % least

    def test_octrees(self):
        self.each("grid_path project", self.projected, table.rows("octrees"))
        self.each("projected_map", self.mapped, table.rows("octrees"))

    def projected(self, row, expect):
        out = os.path.join(self.folder_of(row), "out.yaml")
        done = run("project", "--octree", os.path.join(DATA, row["make"]), "--map", out, "--min-z", "0", "--max-z", "1")
        counts = "unknown %d, occupied %d" % (expect["unknown"], expect["occupied"])
        return "" if done.returncode == 0 and counts in done.stdout else done.stderr + done.stdout

    def mapped(self, row, expect):
        name = shutil.copy(os.path.join(DATA, row["make"]), self.folder_of(row))
        node = foreign_nodes.ForeignNode("projected_map", Row(
            inputs={}, outputs={"projected_map": "nav_msgs/OccupancyGrid"}, services={}, actions={},
            arguments=[name, "_occupancy_min_z:=0", "_occupancy_max_z:=1", "_autosave_period:=0"], tf="", probe=None),
            self.folder.name, space="/" + row["id"])
        try:
            def counts():
                data = list(node.heard("projected_map")[-1].data) if node.heard("projected_map") else []
                return data.count(100), data.count(-1)
            right = wait_until(lambda: counts() == (expect["occupied"], expect["unknown"]) or not node.lives(), 20.0)
            return "" if right and node.lives() else "%r: %s" % (counts(), node.said())
        finally:
            node.end(9)

    def test_maps_of_map_publisher(self):
        self.each("map_publisher", self.published)

    def published(self, row, expect):
        name = foreign_files.map_file(row, self.folder_of(row))
        node = foreign_nodes.ForeignNode("map_publisher", Row(
            inputs={}, outputs={"projected_map": "nav_msgs/OccupancyGrid"}, services={}, actions={},
            arguments=[name], tf="", probe=None), self.folder.name, space="/" + row["id"])
        try:
            if "refused" in expect:
                return "" if wait_until(lambda: node.says(expect["refused"], 0) or None) else node.said()
            if not wait_until(lambda: node.heard("projected_map") or not node.lives()) or not node.heard("projected_map"):
                return "no map: " + node.said()
            data = list(node.heard("projected_map")[-1].data)
            wanted = rooms.cells(0, -1) if expect.get("sees") == "unknown" else rooms.cells()
            return "" if data == wanted else "other cells"
        finally:
            node.end(9)

    def test_waypoints_of_the_command(self):
        self.each("grid_path waypoints", self.converted, table.rows("waypoint_files"))

    def converted(self, row, expect):
        folder = self.folder_of(row)
        out = os.path.join(folder, "out.yaml")
        done = run("waypoints", "--input", foreign_files.waypoint_file(row, folder), "--output", out)
        if "refused" in expect:
            return "" if done.returncode == 2 and re.search(expect["refused"], done.stderr) else done.stderr + done.stdout
        if done.returncode != 0:
            return done.stderr + done.stdout
        return self.wrong(out, expect)

    @staticmethod
    def wrong(file, expect):
        with open(file) as text:
            found = yaml.safe_load(text)["waypoints"]
        east, north = (500000.0, 4500000.0) if expect["waypoints"] == "utm" else (0.0, 0.0)
        places = [(p["position"]["x"], p["position"]["y"],
                   2.0 * math.atan2(p["orientation"]["z"], p["orientation"]["w"])) for p in found]
        wanted = [(x + east, y + north, yaw) for x, y, yaw in foreign_files.PLACES]
        near = len(places) == 2 and all(abs(a - b) < 1e-5 for p, q in zip(places, wanted) for a, b in zip(p, q))
        return "" if near else repr(places)


if __name__ == "__main__":
    rospy.init_node("foreign_files", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_files", Files)
