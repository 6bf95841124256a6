#!/usr/bin/env python3
"""Files of other programs, to every command and node that reads them: maps to grid_path plan and map_publisher, waypoints to
grid_path waypoints and navigate_path.

`expect` has sees (room; unknown: all but the wall), told and refused as foreign_maps_rostest.py, or waypoints: both, or utm.
"""
import json
import math
import os
import re
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
        done = run("plan", "--map", foreign_files.map_file(row, self.folder_of(row)), *PLAN)
        if expect.get("sees") == "unknown":
            return "" if done.returncode == 1 and "unknown cell" in done.stdout else done.stderr + done.stdout
        if "refused" in expect:
            return "" if done.returncode == 2 and re.search(expect["refused"], done.stderr) else done.stderr + done.stdout
        if done.returncode != 0:
            return done.stderr + done.stdout
        if not re.search(expect.get("told", ""), done.stderr):
            return "it does not say %s" % expect["told"]
        length = json.loads(done.stdout)["length_m"]
        return "" if abs(length - rooms.AROUND) < 1e-9 else "%.9f m" % length

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
