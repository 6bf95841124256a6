#!/usr/bin/env python3
"""The last thing that a node commands is a zero, however it or its manager is ended."""
import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosnode
import rospy
import rostest

import node_probes as probes
from commanders import COMMANDERS, DEADLINE, CommanderTest, RunningCommander
from own_master import start_own_master
from running_nodes import PACKAGE


class EveryCommanderEnd(CommanderTest):
    def test_signals_end_in_a_zero(self):
        for name in COMMANDERS:
            for number in (signal.SIGINT, signal.SIGTERM):
                node = self.moving(name)
                self.assertIsNotNone(node.end(number), name)
                self.assertTrue(probes.until(self.anybody(), node.ends_in_zeros, time.monotonic() + DEADLINE), name)

    def test_a_manager_that_is_signalled_leaves_a_zero(self):
        """roscpp closes the connections at SIGINT before a nodelet hears of it, and SIGTERM ends a manager at once."""
        for number in (signal.SIGINT, signal.SIGTERM):
            self.managers_leave_zeros(lambda node, number=number: node.processes[0].send_signal(number), "signal %d" % number)

    def test_a_manager_that_is_asked_to_end_leaves_a_zero(self):
        """By `rosnode kill`; roscpp closes the connections before a nodelet hears of it, as at SIGINT."""
        self.managers_leave_zeros(lambda node: rosnode.kill_nodes([node.space + "/manager"]), "rosnode kill")

    def test_a_manager_whose_name_another_takes_leaves_a_zero(self):
        """The master asks it to end."""
        self.managers_leave_zeros(RunningCommander.start_manager, "another of its name")

    def managers_leave_zeros(self, ask_to_end, what):
        for name in COMMANDERS:
            node = self.moving(name, "nodelet")
            manager = node.processes[0]
            ask_to_end(node)
            self.assertTrue(probes.until(self.anybody(), lambda: manager.poll() is not None,
                                         time.monotonic() + DEADLINE), "%s after %s" % (name, what))
            self.assertTrue(probes.until(self.anybody(), node.ends_in_zeros, time.monotonic() + DEADLINE),
                            "%s after %s: %s" % (name, what, self.said(node)))
            node.end(signal.SIGKILL)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_end")
    rostest.rosrun(PACKAGE, "every_commander_end", EveryCommanderEnd)
