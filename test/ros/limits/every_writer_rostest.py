#!/usr/bin/env python3
"""All that nodes and commands write, on a disk that is full and on one that is read-only: refused with a sentence, what
was written before is whole, nothing is left beside it, no node ends, and all is written when there is room.

The disk is a file system in memory, mounted where this program alone sees it; where that is not allowed nothing is run.
"""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import rospkg
import rospy
import rostest

PACKAGE = "grid_path_planner"
ROOT = rospkg.RosPack().get_path(PACKAGE)
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, os.pardir, "security"), os.path.join(ROOT, "scripts")]
import bags  # noqa: E402
from commands import Commands  # noqa: E402
from message_classes import message_class  # noqa: E402
from right_messages import of  # noqa: E402
from ros_session import executable  # noqa: E402
from storms import node_writers, small_disk  # noqa: E402
from storms.small_disk import TROUBLES, SmallDisk  # noqa: E402

SECONDS = 60.0  # for a node to begin, a command to end
FLOAT32 = 7  # of sensor_msgs/PointField
ALL_OR_NOTHING = ("plan", "scenarios", "rectangles", "convert", "waypoints", "project")  # but for project_image
PAGES = 1  # of room: for the picture of a map without its YAML, for the begin of a report


def disk_or_skip(case):
    folder = tempfile.TemporaryDirectory()
    case.addCleanup(folder.cleanup)
    disk = SmallDisk(os.path.join(folder.name, "disk"))
    case.addCleanup(disk.__exit__)
    try:
        disk.__enter__()
    except small_disk.NotRun as reason:
        case.skipTest(str(reason))
    return folder.name, disk


class Nodes:
    """path_planner and projected_map, with a map, and what is seen of it."""

    def __init__(self, folder, save_folder):
        self.walls, self.processes = 0, {}
        self.log = open(os.path.join(folder, "log"), "w")
        for node, more in (("path_planner", []), ("projected_map", ["_autosave_period:=0.2", "_diagnostic_period:=0.1",
                                                                       "_always_send_full_map:=true"])):
            rospy.delete_param("/" + node) if rospy.has_param("/" + node) else None
            self.processes[node] = subprocess.Popen([executable(node), "--save-folder", save_folder] + more,
                                                    stdout=self.log, stderr=subprocess.STDOUT)
        for service in ("/path_planner/make_plan", "/projected_map/save_octree"):
            rospy.wait_for_service(service, SECONDS)
        from nav_msgs.srv import GetPlan
        self.clouds = rospy.Publisher("cloud_in", message_class("sensor_msgs/PointCloud2"), queue_size=10)
        self.make_plan = rospy.ServiceProxy("/path_planner/make_plan", GetPlan)
        wait_until(lambda: self.clouds.get_num_connections() > 0, "subscriber of clouds")
        self.see()
        wait_until(self.plan, "path")

    def see(self):
        """Another wall, which projected_map maps."""
        self.walls += 1
        x = 1.05 + 0.1 * (self.walls % 100)
        points = [struct.pack("<fff", x, 0.05 * y, 0.05 * z) for y in range(-40, 40) for z in range(-8, 8)]
        cloud = of("sensor_msgs/PointCloud2", header={"frame_id": "map"}, height=1, width=len(points), point_step=12,
                   row_step=12 * len(points), is_dense=True)
        cloud.header.stamp = rospy.Time.now()
        cloud.fields = [message_class("sensor_msgs/PointField")(name, 4 * i, FLOAT32, 1) for i, name in enumerate("xyz")]
        cloud.data = b"".join(points)
        self.clouds.publish(cloud)

    def plan(self, to=0.75):
        start, goal = (of("geometry_msgs/PoseStamped", header={"frame_id": "map"},
                          pose={"position": {"x": x}, "orientation": {"w": 1.0}}) for x in (0.25, to))
        return self.make_plan(start=start, goal=goal).plan.poses

    def ended(self):
        return [node for node, process in self.processes.items() if process.poll() is not None]

    def end(self):
        for process in self.processes.values():
            process.terminate()
        for process in self.processes.values():
            process.wait(SECONDS)
        self.log.close()


def wait_until(done, what):
    deadline = time.monotonic() + SECONDS
    while not done():
        if time.monotonic() > deadline:
            raise AssertionError("no %s within %.0f s" % (what, SECONDS))
        time.sleep(0.02)


def record_plans(case, folder):
    """A bag for each variant, of a node that plans."""
    from grid_path_planner.msg import PlanRecord
    from nav_msgs.msg import OccupancyGrid
    nodes = Nodes(folder, os.path.join(folder, "saved"))
    case.addCleanup(nodes.end)
    maps, records = [], []
    subscribers = [rospy.Subscriber("projected_map", OccupancyGrid, maps.append),
                   rospy.Subscriber("plan_record", PlanRecord, records.append)]
    wait_until(lambda: maps and nodes.plan() and records, "record")
    for variant in (0, 1):
        records.clear()
        nodes.plan(0.75 - 0.1 * variant)
        wait_until(lambda: records, "record")
        bags.write_plans(os.path.join(folder, "plan%d.bag" % variant),
                         [("projected_map", maps[-1]), ("plan_record", records[-1])])
    for subscriber in subscribers:
        subscriber.unregister()


class EveryWriter(unittest.TestCase):
    def test_nodes(self):
        folder, disk = disk_or_skip(self)
        nodes = Nodes(folder, disk.folder)
        self.addCleanup(nodes.end)
        writers = node_writers.NodeWriters(disk.folder, nodes.plan, nodes.see)
        node_writers.check_written(writers)
        for trouble in TROUBLES:
            with disk.trouble(trouble):
                node_writers.check_refused(writers, disk, trouble)
            node_writers.check_written(writers)
        node_writers.check_log_that_fills(writers, disk)
        self.assertEqual(nodes.ended(), [])


    def test_commands(self):
        folder, disk = disk_or_skip(self)
        commands = Commands(ROOT, folder, disk.folder)
        record_plans(self, folder)
        bags.write_dive(os.path.join(folder, "dive.bag"))
        os.mkdir(commands.to("replay"))
        self.variant = 0
        self.check_written(commands)
        for trouble in TROUBLES:
            self.remove_fresh(disk)
            before = disk.contents()
            with disk.trouble(trouble):
                for row in commands.rows:
                    self.check_refused(commands, row, TROUBLES[trouble])
                self.assertEqual(self.kept(disk), before, trouble)
            self.check_written(commands)
        self.check_that_fills(commands, disk)

    def run_row(self, commands, row, **streams):
        return run([executable("grid_path")] + commands.rows[row](self.variant), **streams)

    def check_written(self, commands):
        """Not what is there already."""
        self.variant = 1 - self.variant
        for row in commands.rows:
            answer = self.run_row(commands, row)
            self.assertEqual(answer.returncode, 0, "%s: %s" % (row, answer.stderr))

    def check_refused(self, commands, row, reason):
        self.variant = 1 - self.variant
        answer = self.run_row(commands, row)
        self.variant = 1 - self.variant
        self.assertGreater(answer.returncode, 0, row)
        self.assertIn(reason, answer.stderr, row)

    def test_what_is_printed(self):
        """A file that the shell has opened, and which is empty by then."""
        folder, disk = disk_or_skip(self)
        commands = Commands(ROOT, folder, folder)
        for words in (["--help"], ["--version"], ["plan", "--help"], commands.row_plan_image(0), commands.row_scenarios(0),
                      commands.row_rectangles_file(0), commands.row_study(0), commands.row_flights(0)):
            with open(os.path.join(disk.folder, "printed"), "w") as file, disk.trouble("full"):
                answer = run([executable("grid_path")] + words, file)
            self.assertGreater(answer.returncode, 0, words)
            self.assertIn("not all that was printed could be written", answer.stderr, words)

    def check_that_fills(self, commands, disk):
        """Each file is the old one or the new one, and the code says whether all are new."""
        self.variant = 1 - self.variant
        for row in commands.rows:
            self.remove_fresh(disk)
            self.variant = 1 - self.variant
            self.run_row(commands, row)
            old = disk.contents()
            self.variant = 1 - self.variant
            with disk.trouble("full"):
                disk.give_room(PAGES)
                answer = self.run_row(commands, row)
                self.assertGreaterEqual(answer.returncode, 0, row)
                self.assertEqual(disk.temporaries(), [], row)
                filled = disk.contents()
            self.assertEqual(self.run_row(commands, row).returncode, 0, row)
            self.check_old_or_new(row, answer, old, filled, disk.contents())

    def check_old_or_new(self, row, answer, old, filled, new):
        if answer.returncode == 0:
            self.assertEqual(sorted(filled), sorted(new), row)
            return
        self.assertTrue(answer.stderr, row)
        if row.startswith(ALL_OR_NOTHING) and row != "project_image":
            self.assertEqual(filled, old, row)
        for name, content in filled.items():
            if not is_streamed(name):
                self.assertIn(content, (old.get(name), new.get(name)), "%s: %s" % (row, name))

    def remove_fresh(self, disk):
        for name in os.listdir(disk.folder):
            if name.startswith("fresh_"):
                path = os.path.join(disk.folder, name)
                shutil.rmtree(path) if os.path.isdir(path) else os.unlink(path)

    def kept(self, disk):
        """What was there before: a folder that could not be begun may be there, without a report."""
        return {name: content for name, content in disk.contents().items() if not name.startswith("fresh_") or content}


def is_streamed(name):
    """Written piece by piece: runs of a study, one a line, and the log of a flight."""
    return name.endswith((".jsonl", ".log"))


def run(command, stdout=subprocess.PIPE):
    return subprocess.run(command, stdout=stdout, stderr=subprocess.PIPE, universal_newlines=True, timeout=SECONDS)


if __name__ == "__main__":
    small_disk.enter_own_mounts()
    rospy.init_node("every_writer")
    rostest.rosrun(PACKAGE, "every_writer", EveryWriter)
