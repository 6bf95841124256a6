#!/usr/bin/env python3
"""A joystick takes the vehicle from every node that drives it, and a hand gives it back."""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rospy
import rostest
from roslib.message import get_service_class
from std_msgs.msg import Bool

import node_probes as probes
from commanders import COMMANDERS, DEADLINE, QUIET, CommanderTest
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE

DRIVERS = [name for name in COMMANDERS if "manual_control" in NODES[name].inputs]


class EveryCommanderJoystick(CommanderTest):
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

    def test_a_joystick_that_is_let_go_at_once_takes_over_all_the_same(self):
        """Of two messages that came together the first was dropped: the drive went on by itself."""
        for name in DRIVERS:
            node = self.moving(name)
            node.processes[0].send_signal(signal.SIGSTOP)
            for commands in (True, False):
                node.send("manual_control", Bool(commands))
            time.sleep(0.2)  # both are there when it goes on
            node.processes[0].send_signal(signal.SIGCONT)
            self.assertTrue(probes.until(node, lambda: not node.moved_after(time.monotonic() - QUIET), time.monotonic() + DEADLINE), name)
            self.assertTrue(self.stays(node), "%s goes on by itself" % name)
            self.assertTrue(self.resumes(node), name)
            self.assertTrue(self.moves(node), name)

    def test_a_joystick_that_was_killed_holds_nobody_for_ever(self):
        for name in DRIVERS:
            node = self.moving(name)

            def holds():
                node.send("manual_control", Bool(True))
                return not self.resumes(node)
            self.assertTrue(probes.until(node, holds, time.monotonic() + DEADLINE), name)
            begin = time.monotonic()
            self.assertTrue(probes.until(node, lambda: node.zeroed_after(begin), time.monotonic() + DEADLINE),
                            "%s leaves the last velocity of a joystick in force" % name)
            self.assertTrue(probes.until(node, lambda: self.resumes(node), time.monotonic() + DEADLINE), name)
            self.assertTrue(self.moves(node), name)

    @staticmethod
    def resumes(node):
        answer = node.call("~resume", get_service_class("std_srvs/Trigger")._request_class())
        return answer is not None and answer.success


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_joystick")
    rostest.rosrun(PACKAGE, "every_commander_joystick", EveryCommanderJoystick)
