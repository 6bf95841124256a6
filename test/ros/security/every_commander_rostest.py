#!/usr/bin/env python3
"""What a vehicle may rely on of whatever commands it: one suite over the table in commanders.py, and over every node
that offers an action.

What was seen before: two navigate_paths drove one vehicle along two paths; two nodelets of one manager did so long after
two nodes could not, since the master knows both by the manager's name.
"""
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import roslib.packages
import rospy
import rostest
from roslib.message import get_service_class
from std_msgs.msg import Bool

import node_probes as probes
from commanders import COMMANDERS, VELOCITIES, RunningCommander, StoppableClock
from node_table import NODES
from running_nodes import PACKAGE, RunningNode, executable

DEADLINE = 60.0   # s
QUIET = 1.0       # s without a motion: it stands
END_SECONDS = 10.0
DRIVERS = [name for name in COMMANDERS if "manual_control" in NODES[name].inputs]


def commands(name):
    """The topics of velocities and the actions that nobody else may command or offer."""
    row = NODES[name]
    return {topic for topic, kind in row.outputs.items() if kind in VELOCITIES} | set(row.actions)


def is_joystick(name):
    return "joy" in NODES[name].inputs


def conflict(first, second):
    """What both command, but for a driver and a joystick, to which it yields."""
    return commands(first) & commands(second) if is_joystick(first) == is_joystick(second) else set()


PAIRS = [(first, second) for first in NODES for second in NODES if conflict(first, second)]


class EveryCommander(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = StoppableClock()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.started = []
        self.addCleanup(self.end_all)

    def end_all(self):
        """Whatever was commanded in the test is finite."""
        for node in self.started:
            node.end(signal.SIGKILL)
            for _, topic, twist in getattr(node, "commands", ()):
                for number in (twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z):
                    self.assertTrue(math.isfinite(number), "%s of %s" % (topic, node))

    def commander(self, name, kind="process", stopped=False):
        self.started.append(RunningCommander(name, kind, self.clock, self.folder, stopped))
        return self.started[-1]

    def moving(self, name, kind="process"):
        node = self.commander(name, kind)
        self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
        return node

    def said(self, node):
        with open(node.log.name, errors="replace") as file:
            return file.read()[-2000:]

    def moves(self, node):
        begin = time.monotonic()
        return probes.until(node, lambda: node.moved_after(begin), begin + DEADLINE, lambda: node.table.offer(node), 2.0)

    def stands(self, node, meanwhile=lambda: None, every=0.1):
        """It soon commands no motion for a while, whatever is done meanwhile, and has said so by a zero."""
        return probes.until(node, lambda: not node.moved_after(time.monotonic() - QUIET) and node.ends_in_zeros(),
                            time.monotonic() + DEADLINE, meanwhile, every)

    def stays(self, node, meanwhile=lambda: None):
        """It commands no motion for a while from now on."""
        begin = time.monotonic()
        while time.monotonic() < begin + QUIET:
            meanwhile()
            time.sleep(0.1)
        return not node.moved_after(begin)

    def test_the_table_has_every_node_that_commands(self):
        self.assertEqual({name for name in NODES if set(NODES[name].outputs.values()) & set(VELOCITIES)}, set(COMMANDERS))
        for name in COMMANDERS:
            self.assertIn("stop", NODES[name].inputs, name)

    def test_stop_zeroes_until_it_is_released(self):
        for name in COMMANDERS:
            node = self.moving(name)
            node.stop(True)
            self.assertTrue(self.stands(node), name)
            self.assertTrue(self.stays(node, lambda: node.table.offer(node)), name)
            node.stop(False)
            self.assertTrue(self.moves(node), name)

    def test_a_stop_from_before_its_start_holds_it(self):
        for name in COMMANDERS:
            node = self.commander(name, stopped=True)
            offered = {"times": 0}

            def offer():
                offered["times"] += 1
                node.table.offer(node)
            self.assertTrue(probes.until(node, lambda: node.is_connected() and offered["times"] > 5,
                                         time.monotonic() + DEADLINE, offer, 0.3), name)
            self.assertTrue(self.stays(node, offer), name)
            node.stop(False)
            self.assertTrue(self.moves(node), "%s: %s" % (name, self.said(node)))

    def test_what_ceases_stops_it(self):
        for name, row in COMMANDERS.items():
            node = self.moving(name)
            for feed in row.feeds:
                node.ceased.add(feed)
                self.assertTrue(self.stands(node), "%s without %s" % (name, feed))
                node.ceased.clear()
                self.assertTrue(self.moves(node), "%s with %s again" % (name, feed))

    def test_a_clock_that_stands_still_stops_it(self):
        for name in [name for name, row in COMMANDERS.items() if row.clock]:
            node = self.moving(name)
            self.clock.stop()
            stood = self.stands(node)
            self.clock.go_on()
            self.assertTrue(stood, name)
            self.assertTrue(self.moves(node), name)

    def test_signals_end_in_a_zero(self):
        for name in COMMANDERS:
            for number in (signal.SIGINT, signal.SIGTERM):
                node = self.moving(name)
                self.assertIsNotNone(node.end(number), name)
                self.assertTrue(probes.until(self.alive(), node.ends_in_zeros, time.monotonic() + END_SECONDS), name)

    @staticmethod
    def alive():
        class Alive:
            @staticmethod
            def lives():
                return True
        return Alive

    def test_a_joystick_takes_over_and_a_hand_gives_back(self):
        for name in DRIVERS:
            node = self.moving(name)

            def hold():
                node.send("manual_control", Bool(True))
            probes.until(node, lambda: not node.moved_after(time.monotonic() - QUIET), time.monotonic() + DEADLINE, hold)
            self.assertTrue(self.stays(node, hold), name)
            self.assertFalse(self.resumes(node), "%s while the joystick commands" % name)
            node.send("manual_control", Bool(False))
            self.assertTrue(self.stays(node), "%s goes on by itself" % name)
            self.assertTrue(self.resumes(node), name)
            self.assertTrue(self.moves(node), name)

    def test_a_joystick_that_was_killed_holds_nobody_for_ever(self):
        for name in DRIVERS:
            node = self.moving(name)
            node.send("manual_control", Bool(True))
            self.assertTrue(probes.until(node, lambda: self.resumes(node), time.monotonic() + DEADLINE), name)
            self.assertTrue(self.moves(node), name)

    @staticmethod
    def resumes(node):
        answer = node.call("~resume", get_service_class("std_srvs/Trigger")._request_class())
        return answer is not None and answer.success

    def first(self, name, kind):
        """A node that is to be alone, all there."""
        row = NODES[name]._replace(arguments=COMMANDERS[name].arguments if name in COMMANDERS else NODES[name].arguments)
        node = RunningNode(name, row, kind, self.clock, self.folder)
        self.started.append(node)
        self.assertTrue(probes.until(node, node.is_connected, time.monotonic() + DEADLINE), str(node))
        return node

    def second(self, node, name):
        """Started beside it, in its namespace and, of nodelets, its manager, by a later name: of two that start at once it is
        the one to go, and the first may not be through yet."""
        words = ["__ns:=" + node.space, "__name:=z_second_" + name]
        if node.kind == "process":
            command = [executable(name)] + words
        else:
            nodelet = roslib.packages.find_node("nodelet", "nodelet")[0]
            command = [nodelet, "load", "%s/%s" % (PACKAGE, name), "manager", "--no-bond"] + words
        process = subprocess.Popen(command, stdout=node.log, stderr=subprocess.STDOUT)
        node.processes.append(process)
        return process

    def refused(self, first, second, kind):
        node = self.first(first, kind)
        process = self.second(node, second)
        try:
            code = process.wait(DEADLINE)
        except subprocess.TimeoutExpired:
            code = 0
        node.processes.remove(process)
        if code == 0:
            process.kill()
        said = self.said(node)
        self.assertNotEqual(0, code, "%s beside %s: %s" % (second, node, said))
        self.assertRegex(said, "the node %s (publishes|offers) " % node.full_name(), "%s beside %s" % (second, node))
        self.assertTrue(node.lives(), str(node))
        node.end(signal.SIGKILL)

    def test_a_second_process_is_refused_and_names_the_first(self):
        for first, second in PAIRS:
            self.refused(first, second, "process")

    def test_a_second_nodelet_of_a_manager_is_refused_and_names_the_first(self):
        for first, second in PAIRS:
            self.refused(first, second, "nodelet")

    def test_a_joystick_and_a_driver_stand_beside_each_other(self):
        for driver in DRIVERS:
            for kind in ("process", "nodelet"):
                for first, second in ((driver, "teleop_joy"), ("teleop_joy", driver)):
                    node = self.first(first, kind)
                    process = self.second(node, second)
                    name = "%s/z_second_%s" % (node.space, second)
                    self.assertTrue(probes.until(node, lambda: self.offers_parameters(name), time.monotonic() + DEADLINE),
                                    "%s beside %s: %s" % (second, node, self.said(node)))
                    self.assertIsNone(process.poll() if kind == "process" else None)
                    node.end(signal.SIGKILL)

    @staticmethod
    def offers_parameters(name):
        """What a node does last of all when it starts."""
        import rosgraph
        services = rosgraph.Master("/every_commander").getSystemState()[2]
        return any(service == name + "/set_parameters" for service, _ in services)


if __name__ == "__main__":
    rospy.init_node("every_commander")
    rostest.rosrun(PACKAGE, "every_commander", EveryCommander)
