#!/usr/bin/env python3
"""Memory that is there in parts, for two seconds: one in five allocations of 200 bytes and more fails (failing_allocations.cpp).

Every node of node_table.py, as process and as nodelet, gets right messages and requests meanwhile. A first failure ends what
asked for the memory, a second one within 10 s ends the node's own process: in order, unless memory fails while it ends, too (by
SIGABRT then). One of its name that is started again, as by respawn, answers. A manager goes on. Before there was this rule each node repaired itself, by 65 catch blocks of which readers went on
finding one more that was missing.
"""
import os
import signal
import sys
import threading
import time

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from nodes_without_memory import (PACKAGE, SECONDS, NodesWithoutMemory, RunningNode, failing_allocations)  # noqa: E402
from node_table import NODES  # noqa: E402
from own_master import start_own_master  # noqa: E402

SHORT_OF_MEMORY = 2.0  # s
TWICE = "not enough memory twice within 10 s"


class EveryNodeAllocations(NodesWithoutMemory):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.switch = os.path.join(cls.folder, "memory_fails")
        RunningNode.environment = failing_allocations(cls.switch)

    def test_every_node_goes_on_or_ends_in_order(self):
        for kind in ("process", "nodelet"):
            for name, row in NODES.items():
                node = self.started(name, row, kind)
                self.holds(self.failures_of(node) > 0, node, "without a failure")
                if self.ends_itself(node):
                    self.assertEqual("process", kind, str(node))
                    self.assertIn(TWICE, self.said(node))
                    self.assertIn(node.processes[0].wait(SECONDS), (0, -signal.SIGABRT), "%s: %s" % (node, self.said(node)))
                    node.end(signal.SIGKILL)
                    node = self.started(name, row, kind)
                self.holds(self.answers(node), node, "after it")
                node.end(signal.SIGKILL)

    @staticmethod
    def said(node):
        with open(node.log.name, errors="replace") as log:
            return log.read()

    def ends_itself(self, node):
        return not node.lives() or TWICE in self.said(node)

    def failures_of(self, node):
        asker = threading.Thread(target=node.row.probe, args=(node, time.monotonic() + SHORT_OF_MEMORY), daemon=True)
        with open(self.switch, "w"):
            asker.start()
        end = time.monotonic() + SHORT_OF_MEMORY
        while time.monotonic() < end and node.lives():
            for topic, kind in node.fed():
                if topic not in ("tf", "tf_static"):  # which come all the time, and are right
                    node.send(topic, node.right(kind))
            time.sleep(0.05)
        failures = os.path.getsize(self.switch)
        os.remove(self.switch)
        asker.join(SECONDS)
        return failures


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_node_allocations_rostest")
    rostest.rosrun(PACKAGE, "every_node_allocations_rostest", EveryNodeAllocations)
