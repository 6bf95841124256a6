#!/usr/bin/env python3
"""The zero that ends a motion while one in five allocations of the thread that commands fails (failing_allocations.cpp).

A tick without memory sends a zero in its place, and a second one within 10 s ends the node in order, whose last command is a zero.
What follows from the code as it was: a last zero that could not be sent for want of memory counted as sent, and the last velocity
stayed in force: of a joystick that was let go, and of a drive that was cancelled.
"""
import os
import signal
import sys
import time

import rospy
import rostest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, os.pardir, "security")]
import node_probes as probes  # noqa: E402
from commanders import COMMANDERS, DEADLINE, CommanderTest, RunningCommander  # noqa: E402
from nodes_without_memory import failing_allocations, skip_where_sanitized  # noqa: E402
from own_master import start_own_master  # noqa: E402
from running_nodes import PACKAGE  # noqa: E402

ENDS = 5


class EveryCommanderAllocations(CommanderTest):
    @classmethod
    def setUpClass(cls):
        skip_where_sanitized()
        super().setUpClass()

    def running(self, name, switch):
        self.started.append(RunningCommander(name, "process", self.clock, self.folder,
                                             environment=failing_allocations(switch, thread="control")))
        return self.started[-1]

    def test_a_node_that_ends_meanwhile_leaves_a_zero(self):
        for name in COMMANDERS:
            for _ in range(ENDS):
                switch = os.path.join(self.folder, name)
                node = self.running(name, switch)
                self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
                with open(switch, "w"):
                    seconds = node.end(signal.SIGINT)
                os.remove(switch)
                self.assertIsNotNone(seconds, str(node))
                self.assertEqual(0, node.processes[-1].returncode, "%s: %s" % (node, self.said(node)))
                self.assertTrue(probes.until(self.anybody(), node.ends_in_zeros, time.monotonic() + DEADLINE), str(node))

    def test_a_node_that_memory_ends_while_it_moves_leaves_a_zero(self):
        for name in COMMANDERS:
            switch = os.path.join(self.folder, name)
            node = self.running(name, switch)
            self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
            with open(switch, "w"):
                ended = probes.until(self.anybody(), lambda: node.processes[-1].poll() is not None, time.monotonic() + DEADLINE)
            os.remove(switch)
            self.assertTrue(ended, "%s: %s" % (node, self.said(node)))
            self.assertEqual(0, node.processes[-1].returncode, "%s: %s" % (node, self.said(node)))
            self.assertIn("not enough memory twice within 10 s", self.said(node))
            self.assertTrue(probes.until(self.anybody(), node.ends_in_zeros, time.monotonic() + DEADLINE), str(node))


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_allocations_rostest")
    rostest.rosrun(PACKAGE, "every_commander_allocations_rostest", EveryCommanderAllocations)
