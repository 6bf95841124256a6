#!/usr/bin/env python3
"""Memory that is there in parts, for two seconds: one in five allocations of 200 bytes and more fails (failing_allocations.cpp).

Every node of node_table.py, as process and as nodelet, gets right messages and requests meanwhile, and answers right data
afterwards. What was seen before: an exception that could not be told for want of memory left the loop of the main thread, whose
unwinding destroyed the node, and ended the process, 22 times of 22; a timer whose call had thrown was never set again, so that
local_planner planned no more; a cloud that was lost left a hole which ended projected_map.
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


class EveryNodeAllocations(NodesWithoutMemory):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.switch = os.path.join(cls.folder, "memory_fails")
        RunningNode.environment = failing_allocations(cls.switch)

    def test_every_node_answers_when_memory_is_back(self):
        for kind in ("process", "nodelet"):
            for name, row in NODES.items():
                node = self.started(name, row, kind)
                self.holds(self.failures_of(node) > 0, node, "without a failure")
                self.holds(self.answers(node), node, "after it")
                node.end(signal.SIGKILL)

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
