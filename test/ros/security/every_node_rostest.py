#!/usr/bin/env python3
"""Whatever a stranger sends, no node ends, and right data is answered afterwards.

One suite over the table in node_table.py, which names every node; each runs as a process and as a nodelet. What was
seen before: a stamp of 2^31 s from now ended path_planner and navigate_path; an action's cancel stamped 2^32 - 1
cancelled every later goal, and a goal stamped so kept every later one from being accepted.
"""
import concurrent.futures
import os
import signal
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospkg
import rospy
import rosservice
import rostest

import hostile_messages as hostile
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE, Clock, RunningNode
from service_connection import ends_after_answer

HANG_SECONDS = 60.0  # for an answer; how long they took at most is printed, and only a quiet machine says something by it
START_SECONDS = 120.0
HALF = 1 << 31
NANOSECONDS = (0, 999999999, (1 << 32) - 1)  # the last as no clock says it, and a message may
NUMBERS = (float("nan"), float("inf"), -float("inf"), 1e300, 1e38, -1e-300)
SIZES = (0, (1 << 32) - 1)
# Of roscpp, dynamic_reconfigure, nodelet and the libraries below; not of a node's own.
COMMON = ("parameter_refused", "parameter_descriptions", "parameter_updates", "set_parameters", "get_loggers", "set_logger_level", "tf",
          "tf_static", "bond", "list", "load_nodelet", "unload_nodelet", "tf2_frames")
OF_ROSCPP = ("get_loggers", "set_logger_level", "tf2_frames")  # services that roscpp and tf2 advertise by themselves
# octomap_msgs may be there or not.
OPTIONAL = ("octomap_binary", "octomap_full")


def own(names):
    return {name for name in names
            if name.split("/")[-1] not in COMMON + OPTIONAL and not name.startswith("manager/")}


def within(node, names):
    """The names in the space of the node, private ones included."""
    return {name.replace("~", node.name + "/") for name in names}


class EveryNode(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        data = os.path.join(rospkg.RosPack().get_path(PACKAGE), "test", "data")
        os.environ["GRID_PATH_PLANNER_LOAD_FOLDER"] = data
        os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder.name, "saved")
        cls.clock = Clock(rospy.get_param("/use_sim_time", False))
        cls.nodes = []
        cls.addClassCleanup(cls.end_nodes)
        for name, row in NODES.items():
            for kind in ("process", "nodelet"):
                cls.nodes.append(RunningNode(name, row, kind, cls.clock, folder.name))
        cls.pool = concurrent.futures.ThreadPoolExecutor(len(cls.nodes))
        cls.longest = cls.longest_end = 0.0

    @classmethod
    def end_nodes(cls):
        for node in cls.nodes:
            node.end(signal.SIGKILL)

    @classmethod
    def tearDownClass(cls):
        print("every_node: the longest answer took %.1f s, the longest end %.1f s" % (cls.longest, cls.longest_end))

    def all(self, ask):
        """The stories of the nodes for which it does not hold: what a test prints is not in the log of CI."""
        return [node.story() for node, holds in zip(self.nodes, self.pool.map(ask, self.nodes)) if not holds]

    def answers(self, node):
        begin = time.monotonic()
        answered = node.row.probe(node, begin + HANG_SECONDS)
        type(self).longest = max(self.longest, time.monotonic() - begin)
        return answered

    def goes_on_after(self, what, change, only=lambda message: True):
        """Sends all messages of all topics, changed, and expects no exit and then right answers."""
        def send(node):
            for topic, kind in node.fed():
                if only(node.right(kind)):
                    for message in change(node.right(kind)):
                        node.send(topic, message)
            return True
        self.all(send)
        time.sleep(0.3)  # what is sent is to be heard before what is right
        self.assertEqual([], self.all(self.answers), "after " + what)
        self.assertEqual([], self.all(RunningNode.lives), "after " + what)

    def test_0_every_node_has_a_row(self):
        package = rospkg.RosPack().get_path(PACKAGE)
        tree = xml.etree.ElementTree.parse(os.path.join(package, "nodelet_plugins.xml"))
        plugins = {entry.get("name").split("/")[1] for entry in tree.iter("class")}
        programs = {name[:-4] for name in os.listdir(os.path.join(package, "src", "nodes")) if name.endswith(".cpp")}
        self.assertEqual(plugins, set(NODES), "nodelet_plugins.xml and node_table.py")
        self.assertEqual(programs, set(NODES), "src/nodes and node_table.py")

    def test_1_right_data_is_answered(self):
        def comes_up(node):
            deadline = time.monotonic() + START_SECONDS
            while not node.is_connected() and time.monotonic() < deadline:
                time.sleep(0.1)
            return node.is_connected()
        self.assertEqual([], self.all(comes_up), "start")
        self.goes_on_after("nothing", lambda message: ())

    def publishes_all(self, node):
        """Waits: what shows a map is published with the map, which may come after a question's answer."""
        deadline = time.monotonic() + START_SECONDS
        while not within(node, node.row.outputs) <= set(node.registered()[1]) and time.monotonic() < deadline:
            time.sleep(0.1)

    def test_2_the_rows_say_what_the_nodes_do(self):
        for node in self.nodes:
            if node.kind == "nodelet":
                continue  # its manager's registrations are those of whatever it has loaded
            self.publishes_all(node)
            inputs, outputs, services = node.registered()
            actions = [action + "/" for action in node.row.actions]
            heard = {name: kind for name, kind in inputs.items() if not name.startswith(tuple(actions))}
            said = {name: kind for name, kind in outputs.items() if not name.startswith(tuple(actions))}
            self.assertEqual(own(heard), set(node.row.inputs), str(node))
            self.assertEqual(own(said), within(node, node.row.outputs), str(node))
            self.assertEqual(own(services), within(node, node.row.services), str(node))
            self.assertEqual("tf" in inputs, "listens" in node.row.tf, str(node))
            self.assertEqual("tf" in outputs, "publishes" in node.row.tf, str(node))
            self.assertEqual({name: heard[name] for name in node.row.inputs}, node.row.inputs)

    def test_2_who_reads_late_has_the_answer(self):
        """roscpp's servers end the connection with the answer, and its clients drop an answer that they have not begun to
        read then: one call in some ten thousand failed on a busy machine."""
        def ending(node):
            own_services = [service for service in rosservice.get_service_list(namespace=node.full_name())
                            if service.split("/")[-1] not in OF_ROSCPP]
            return [service for service in own_services if ends_after_answer(service, "/every_node", 0.5)]
        self.assertEqual([], sum(self.pool.map(ending, self.nodes), []))

    def test_3_stamps(self):
        now = self.clock.now().secs
        for seconds in (0, 1, now + HALF, max(0, now - HALF), (1 << 32) - 1):
            for nanoseconds in NANOSECONDS:
                stamp = hostile.raw_time(min(seconds, (1 << 32) - 1), nanoseconds)
                self.goes_on_after("stamps of %d.%09d" % (seconds, nanoseconds), lambda message: [
                    hostile.stamped(message, stamp)] * 2, hostile.has_stamp)

    def test_3_stamps_of_the_clock(self):
        """Time that all nodes share jumps there and back."""
        if not self.clock.simulated:
            self.skipTest("the wall's clock says what it says")
        now = self.clock.now().secs
        for seconds in (0, 1, now + HALF, max(0, now - HALF), (1 << 32) - 1):
            for nanoseconds in NANOSECONDS:
                for _ in range(3):
                    self.clock.say(hostile.raw_time(seconds, nanoseconds))
                    time.sleep(0.03)
                what = "a clock of %d.%09d" % (seconds, nanoseconds)
                self.assertEqual([], self.all(self.answers), "after " + what)
                self.assertEqual([], self.all(RunningNode.lives), "after " + what)

    def test_4_numbers(self):
        for number in NUMBERS:
            self.goes_on_after("numbers of %g" % number, lambda message: [hostile.with_numbers(message, number)])

    def test_5_frames(self):
        for frame in hostile.HOSTILE_FRAMES:
            self.goes_on_after("the frame %r" % frame, lambda message: [hostile.with_frames(message, frame)])

    def test_5_no_frame_is_the_map_frame(self):
        """Of maps, goals, paths, fixes; what a sensor measured names where it was. Goals and paths were refused, maps were taken
        by some nodes and refused by others."""
        for node in self.nodes:
            node.map_frame = ""
        try:
            self.assertEqual([], self.all(self.answers))
        finally:
            for node in self.nodes:
                node.map_frame = "map"

    def test_6_sizes(self):
        for size in SIZES:
            self.goes_on_after("sizes of %d" % size, lambda message: [hostile.with_sizes(message, size)])

    def test_7_broken_messages(self):
        self.goes_on_after("broken messages", hostile.broken)

    def test_8_signals_end_them(self):
        for node in self.nodes:
            seconds = node.end(signal.SIGINT if node.name < "n" else signal.SIGTERM)
            self.assertIsNotNone(seconds, str(node))
            type(self).longest_end = max(self.longest_end, seconds)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_node")
    rostest.rosrun(PACKAGE, "every_node", EveryNode)
