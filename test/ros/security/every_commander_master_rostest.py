#!/usr/bin/env python3
"""What drives without a ROS master: it goes on for master_timeout, says so in its diagnostics, and then stands.

What was seen before: local_planner's diagnostics had no word of the master, and those of navigate_path none of when it
stands.
"""
import os
import re
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

import node_probes as probes
from commanders import COMMANDERS, DEADLINE, CommanderTest, RunningCommander
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE
from slow_master import CeasingMaster

TIMEOUT = 20.0  # s; above what a node takes to notice, on a busy machine too
WARNING = "the ROS master does not answer"
DRIVERS = [name for name in COMMANDERS if "manual_control" in NODES[name].inputs]
BY_HAND = {"teleop_joy"}  # who holds the deadman sees the vehicle; joy_timeout notices a joystick that is gone


class EveryCommanderMaster(CommanderTest):
    def setUp(self):
        super().setUp()
        self.told, self.lock = [], threading.Lock()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self.keep)
        self.addCleanup(subscriber.unregister)

    def keep(self, message):
        with self.lock:
            self.told += [(time.monotonic(), status) for status in message.status]

    def says(self, node, words, level):
        """When it first did in its diagnostics; None: not yet."""
        with self.lock:
            found = [at for at, status in self.told if node.space[1:] in status.name and re.search(words, status.message) and
                     status.level == level]
        return found[0] if found else None

    def driving(self, name, master):
        node = RunningCommander(name, "process", self.clock, self.folder, master=master.uri,
                                arguments=["_master_timeout:=%g" % TIMEOUT])
        self.started.append(node)
        self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
        self.assertTrue(probes.until(node, lambda: self.says(node, "", DiagnosticStatus.OK),
                                     time.monotonic() + DEADLINE), "%s has no diagnostics" % node)
        self.assertIsNone(self.says(node, WARNING, DiagnosticStatus.WARN), str(node))
        return node

    def goes_on_says_so_and_stands(self, name, cease):
        master = CeasingMaster(rosgraph.get_master_uri())
        self.addCleanup(master.end)
        node = self.driving(name, master)
        getattr(master, cease)()
        begin = time.monotonic()
        what = "%s whose master must %s" % (node, cease)

        def warned():
            return self.says(node, "%s: the vehicle stands %g s after" % (WARNING, TIMEOUT), DiagnosticStatus.WARN)
        self.assertTrue(probes.until(node, warned, time.monotonic() + DEADLINE), what)
        self.assertTrue(probes.until(node, lambda: node.moved_after(warned()), time.monotonic() + DEADLINE),
                        "%s does not go on" % what)
        self.assertTrue(self.stands(node), "%s does not stand: %s" % (what, self.said(node)))
        self.assertGreater(time.monotonic(), begin + TIMEOUT - 2.0, "%s stands too early" % what)
        self.assertTrue(probes.until(node, lambda: self.says(node, WARNING + ": the vehicle stands$", DiagnosticStatus.WARN),
                                     time.monotonic() + DEADLINE), what)
        return node, master

    def test_one_that_falls_silent(self):
        for name in DRIVERS:
            node, master = self.goes_on_says_so_and_stands(name, "fall_silent")
            master.goes_on.set()
            self.assertTrue(self.moves(node), "%s does not go on with its master again" % node)

    def test_one_that_is_gone(self):
        for name in DRIVERS:
            self.goes_on_says_so_and_stands(name, "die")

    def test_every_commander_drives_or_is_driven_by_hand(self):
        self.assertEqual(set(COMMANDERS), set(DRIVERS) | BY_HAND)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_master")
    rostest.rosrun(PACKAGE, "every_commander_master", EveryCommanderMaster)
