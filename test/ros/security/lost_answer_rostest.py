#!/usr/bin/env python3
"""A node ends although an answer of the master is lost, while the master answers all else.

What was seen before: once in some hundred ends roscpp stood in poll() for an answer to a name given back, without a
limit of time, and the master answered everybody. A node that ends only where the master answers nobody stood for good.
"""
import os
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosgraph
import rosnode
import rospy
import rostest

from own_master import start_own_master
from running_nodes import PACKAGE, executable
from slow_master import SlowMaster

DEADLINE = 60.0  # s
LOST = 10.0 * DEADLINE  # s: an answer that comes later than any test ends
GIVEN_BACK = ("unregisterPublisher", "unregisterSubscriber", "unregisterService")


def started(node, master):
    environment = dict(os.environ, ROS_MASTER_URI=master.uri)
    return subprocess.Popen([executable(node), "__name:=" + node], env=environment, stdout=subprocess.DEVNULL)


def is_up(node):
    try:
        return rosnode.rosnode_ping("/" + node, max_count=1)
    except rosnode.ROSNodeIOException:
        return False


class LostAnswer(unittest.TestCase):
    def ends(self, node, method, times):
        """Each time; again where nothing was lost, since on a busy machine a node may find no answer within its 0.2 s before it
        asks for `method`."""
        end = time.monotonic() + DEADLINE
        while not self.lost_at_end(node, method, times):
            self.assertLess(time.monotonic(), end, "%s, %s: nothing was lost" % (node, method))

    def lost_at_end(self, node, method, times):
        master = SlowMaster(rosgraph.get_master_uri(), LOST, times, method)
        process = started(node, master)
        try:
            end = time.monotonic() + DEADLINE
            while not is_up(node) and time.monotonic() < end:
                time.sleep(0.05)
            self.assertTrue(is_up(node))
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(DEADLINE), 0, "%s, %s" % (node, method))
            return bool(master.asked_at)
        finally:
            process.kill()
            master.end()

    def test_of_each_kind(self):
        for method in GIVEN_BACK:
            self.ends("path_planner", method, 1)

    def test_three_in_a_row(self):
        self.ends("go_to_pose", "unregisterPublisher", 3)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("lost_answer")
    rostest.rosrun(PACKAGE, "lost_answer", LostAnswer)
