#!/usr/bin/env python3
"""The zero that ends a motion while one in five allocations of the thread that commands fails (failing_allocations.cpp).

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

ROUNDS, ENDS = 8, 5
SHORT_OF_MEMORY = 0.4  # s


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

    def test_zeros_that_memory_kept_back_come_when_it_is_there(self):
        for name in COMMANDERS:
            switch = os.path.join(self.folder, name)
            node = self.running(name, switch)
            rounds, failures, deadline = 0, 0, time.monotonic() + DEADLINE
            while rounds < ROUNDS or failures <= ROUNDS:  # a busy machine's thread allocates seldom
                self.assertLess(time.monotonic(), deadline, "%s: %d failures in %d rounds" % (name, failures, rounds))
                failures += self.failures_of_a_halt(node, switch)
                rounds += 1
            self.assertTrue(self.moves(node), "%s: %s" % (name, self.said(node)))

    def failures_of_a_halt(self, node, switch):
        """A joystick that is let go is not fed on."""
        self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
        node.cease("joy")
        halt = lambda: node.table.halt(node)
        with open(switch, "w"):
            end = time.monotonic() + SHORT_OF_MEMORY
            while time.monotonic() < end:
                halt()
                time.sleep(0.05)
        failures = os.path.getsize(switch)
        os.remove(switch)
        self.assertTrue(self.stands(node, halt), "%s: %s" % (node, self.said(node)))
        node.ceased.clear()
        return failures


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_allocations_rostest")
    rostest.rosrun(PACKAGE, "every_commander_allocations_rostest", EveryCommanderAllocations)
