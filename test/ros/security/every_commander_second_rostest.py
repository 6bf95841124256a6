#!/usr/bin/env python3
"""A second node that commands the vehicle of the first is refused; a joystick and a driver stand beside each other."""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospy
import rostest

import node_probes as probes
from commander_pairs import DRIVERS, PAIRS, PairTest
from commanders import DEADLINE
from own_master import start_own_master
from running_nodes import PACKAGE


class EveryCommanderSecond(PairTest):
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
                    name = "%s/second_%s" % (node.space, second)
                    self.assertTrue(probes.until(node, lambda: self.is_up(name), time.monotonic() + DEADLINE),
                                    "%s beside %s: %s" % (second, node, self.said(node)))
                    self.assertIsNone(process.poll() if kind == "process" else None)
                    node.end(signal.SIGKILL)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_second")
    rostest.rosrun(PACKAGE, "every_commander_second", EveryCommanderSecond)
