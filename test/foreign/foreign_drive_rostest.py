#!/usr/bin/env python3
"""What octomap_server published is driven on, end to end: its recorded maps, a plan, the waypoint file of it, the drive.

The vehicle starts where the survey saw the middle of the site, the goal is beyond the structure there. The survey goes on while
it is driven: whole maps with other origins and sizes, an orientation of zeros in each.
"""
import math
import os
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosbag
import rospy
import rostest
import yaml
from foreign_nodes import wait_until
from message_classes import message_class
from right_messages import of

BAG = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "foreign", "octomap_server.bag")
HALF = 88.0  # s of the recording: maps until then are planned on, the others come while the plan is driven
START, GOAL, YAW = (2.0, -1.0), (12.5, -2.0), -1.0
RADIUS = 0.4  # m
UNKNOWN = -1
ASSUMED = "orientation"
PLANNER = {"radius": RADIUS, "unknown_is_passable": False, "decay": 4.0, "inflation_weight": 10}
DRIVER = {"check_radius": 0.3, "stop_at_unknown": True}


def recorded():
    """Its maps with cells, as (s from the beginning, map)."""
    with rosbag.Bag(BAG) as bag:
        messages = [(time.to_sec() - bag.get_start_time(), message) for _, message, time in bag.read_messages()]
    return [(time, message) for time, message in messages if message.info.width]


def distance_to_cell(info, index, point):
    west = info.origin.position.x + (index % info.width) * info.resolution
    south = info.origin.position.y + (index // info.width) * info.resolution
    return math.hypot(max(west - point[0], 0.0, point[0] - west - info.resolution),
                      max(south - point[1], 0.0, point[1] - south - info.resolution))


def clearance(message, points):
    """From points to the nearest cell that is not free, m."""
    info = message.info
    near = [index for index, value in enumerate(message.data) if value == UNKNOWN or value >= 65]
    return min(distance_to_cell(info, index, point) for point in points for index in near)


def place_of(pose):
    return pose.position.x, pose.position.y


class Drive(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.heard = {}
        for topic, kind in (("path", "nav_msgs/Path"), ("plan_statistics", "grid_path_planner/PlanStatistics"),
                            ("projected_map", "nav_msgs/OccupancyGrid"), ("ground_truth", "nav_msgs/Odometry"),
                            ("contacts", "std_msgs/UInt32"), ("/rosout", "rosgraph_msgs/Log"),
                            ("/diagnostics", "diagnostic_msgs/DiagnosticArray")):
            self.heard[topic] = []
            rospy.Subscriber(topic, message_class(kind), self.heard[topic].append)
        self.goals = rospy.Publisher("/move_base_simple/goal", message_class("geometry_msgs/PoseStamped"), queue_size=1)

    def start(self, *command):
        log = open(os.path.join(self.folder, "log"), "a")
        self.addCleanup(log.close)
        process = subprocess.Popen(command, stdout=log, stderr=log)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        process.wait()

    def play(self, *options):
        return self.start("rosbag", "play", "--quiet", "--wait-for-subscribers", *options, BAG, "__name:=octomap_server")

    def launch(self, name, parameters, **arguments):
        overrides = os.path.join(self.folder, name + ".yaml")
        with open(overrides, "w") as file:
            yaml.safe_dump(parameters, file)
        return self.start("roslaunch", "grid_path_planner", name + ".launch", "overrides:=" + overrides,
                          *("%s:=%s" % argument for argument in arguments.items()))

    def said(self):
        with open(os.path.join(self.folder, "log")) as log:
            return log.read()[-3000:]

    def comes(self, holds, what, **options):
        answer = wait_until(holds, 120.0, **options)
        self.assertTrue(answer, "%s: %s, %s; what was said:\n%s" % (
            what, self.driver_says("path following")[0], self.driver_says("map")[0], self.said()))
        return answer

    def send_goal(self):
        now = rospy.Time.now()
        self.goals.publish(of("geometry_msgs/PoseStamped", header={"frame_id": "map", "stamp": {"secs": now.secs, "nsecs": now.nsecs}},
                              pose={"position": {"x": GOAL[0], "y": GOAL[1]},
                                    "orientation": {"z": math.sin(YAW / 2), "w": math.cos(YAW / 2)}}))

    def driver_says(self, part):
        """Of its newest diagnostics: the sentence and the values."""
        for array in reversed(self.heard["/diagnostics"]):
            for status in array.status:
                if status.name == "navigate_path: " + part:
                    return status.message, {entry.key: entry.value for entry in status.values}
        return "", {}

    def test_map_plan_file_drive(self):
        maps = recorded()
        newest = [message for time, message in maps if time <= HALF][-1]
        waypoints = os.path.join(self.folder, "waypoints.yaml")
        self.launch("planner", PLANNER, waypoints_file=waypoints)
        self.comes(lambda: self.goals.get_num_connections() > 0, "no planner")
        player = self.play("-r", "30", "-u", "%g" % HALF, "--keep-alive")
        self.comes(lambda: any(m.header.stamp == newest.header.stamp for m in self.heard["projected_map"]), "the maps do not come")
        path = self.comes(lambda: self.planned(newest), "no path that keeps %g m to what is not free" % RADIUS,
                          send=self.send_goal, every=2.0)
        driven = self.comes(lambda: self.written(waypoints, path), "no file of that path")
        self.end(player)

        self.play("-r", "0.5", "-s", "%g" % HALF)
        before = len(self.heard["projected_map"])
        self.launch("navigate_path", DRIVER, config_filename=waypoints)
        self.comes(lambda: self.driver_says("path following")[0].startswith("arrived"), "it does not arrive")
        values = self.driver_says("path following")[1]
        self.assertEqual((str(len(driven)), "0"), (values["waypoints"], values["missed waypoints"]))
        at = self.heard["ground_truth"][-1].pose.pose
        self.assertLess(math.hypot(at.position.x - GOAL[0], at.position.y - GOAL[1]), 0.1)
        self.assertLess(abs(2.0 * math.atan2(at.orientation.z, at.orientation.w) - driven[-1][2]), 0.1)
        self.assertEqual(0, self.heard["contacts"][-1].data)
        came = {m.header.stamp.to_sec() for m in self.heard["projected_map"][before:] if m.info.width}
        self.assertGreater(len(came), 3, "the survey does not go on while it is driven")
        self.assertEqual("/octomap_server", self.driver_says("map")[1]["publisher"])
        self.told_once()

    def planned(self, newest):
        paths = [path for path in self.heard["path"] if path.poses]
        statistics = self.heard["plan_statistics"]
        if not paths or not statistics or statistics[-1].status != "FOUND":
            return None
        points = [place_of(pose.pose) for pose in paths[-1].poses]
        return points if clearance(newest, points) >= RADIUS - 1e-6 else None

    @staticmethod
    def written(name, path):
        """The poses of the file, once they are of the path."""
        if not os.path.exists(name):
            return None
        with open(name) as file:
            poses = yaml.safe_load(file)["waypoints"]
        places = [(p["position"]["x"], p["position"]["y"], 2.0 * math.atan2(p["orientation"]["z"], p["orientation"]["w"]))
                  for p in poses]
        ends = (START, GOAL)
        near = all(math.dist(place[:2], end) < 0.1 for place, end in zip((places[0], places[-1]), ends))
        return places if near and all(min(math.dist(place[:2], point) for point in path) < 1e-3 for place in places) else None

    def told_once(self):
        for node in ("/path_planner", "/navigate_path"):
            told = [log.msg for log in self.heard["/rosout"] if log.name == node and ASSUMED in log.msg]
            self.assertEqual(1, len(told), "%s: %r" % (node, told))


if __name__ == "__main__":
    rospy.init_node("foreign_drive", disable_signals=True)
    rostest.rosrun("grid_path_planner", "foreign_drive", Drive)
