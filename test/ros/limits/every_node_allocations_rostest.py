#!/usr/bin/env python3
"""Memory that is there in parts, for two seconds: one in five allocations of 200 bytes and more fails (failing_allocations.cpp).

Every node of node_table.py, as process and as nodelet, gets right messages and requests meanwhile, and answers right data
afterwards. What was seen before: an exception that could not be told for want of memory left the loop of the main thread, whose
unwinding destroyed the node, and ended the process, 24 times of 24; a timer whose call had thrown was never set again, so that
local_planner planned no more; a cloud that was lost left a hole which ended projected_map.
"""
import os
import signal
import sys
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
import rostest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, os.pardir, "security")]
import node_probes as probes  # noqa: E402
from node_table import NODES  # noqa: E402
from own_master import start_own_master  # noqa: E402
from running_nodes import PACKAGE, Clock, RunningNode, executable, is_sanitized, threads_of  # noqa: E402
from session_clock import session_seconds  # noqa: E402

SECONDS = 60.0          # for the start, for a right answer
SHORT_OF_MEMORY = 2.0  # s


def library():
    return os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", "libfailing_allocations.so")


class EveryNodeAllocations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if is_sanitized(executable("path_planner")):
            raise unittest.SkipTest("a sanitizer has an operator new of its own")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        os.environ["GRID_PATH_PLANNER_LOAD_FOLDER"] = os.path.join(rospkg.RosPack().get_path(PACKAGE), "test", "data")
        os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder.name, "saved")
        os.environ["ROSCONSOLE_STDOUT_LINE_BUFFERED"] = "1"
        cls.folder, cls.clock = folder.name, Clock(False)
        cls.switch = os.path.join(folder.name, "memory_fails")
        RunningNode.environment = dict(os.environ, LD_PRELOAD=library(), FAILING_ALLOCATIONS=cls.switch)

    def test_every_node_answers_when_memory_is_back(self):
        for kind in ("process", "nodelet"):
            for name, row in NODES.items():
                node = RunningNode(name, row, kind, self.clock, self.folder)
                self.addCleanup(node.end, signal.SIGKILL)
                self.holds(probes.until(node, node.is_connected, session_seconds() + SECONDS) and self.answers(node), node, "at its start")
                self.holds(self.failures_of(node) > 0, node, "without a failure")
                self.holds(self.answers(node), node, "after it")
                node.end(signal.SIGKILL)

    def failures_of(self, node):
        asker = threading.Thread(target=node.row.probe, args=(node, session_seconds() + SHORT_OF_MEMORY), daemon=True)
        with open(self.switch, "w"):
            asker.start()
        end = session_seconds() + SHORT_OF_MEMORY
        while session_seconds() < end and node.lives():
            for topic, kind in node.fed():
                if topic not in ("tf", "tf_static"):  # which come all the time, and are right
                    node.send(topic, node.right(kind))
            time.sleep(0.05)
        failures = os.path.getsize(self.switch)
        os.remove(self.switch)
        asker.join(SECONDS)
        return failures

    def answers(self, node):
        return node.row.probe(node, session_seconds() + SECONDS) and node.lives()

    def log(self, node):
        with open(node.log.name, errors="replace") as log:
            return log.read()

    def holds(self, done, node, what):
        """Asks the debugger for the node's threads only where it does not."""
        if not done:
            self.fail("%s, %s, %s, whose log ends with: %s\nIts threads:\n%s" % (
                what, node, "which runs" if node.lives() else "which has ended", self.log(node)[-1500:],
                "\n".join(threads_of(process) for process in node.processes)))


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_node_allocations_rostest")
    rostest.rosrun(PACKAGE, "every_node_allocations_rostest", EveryNodeAllocations)
