#!/usr/bin/env python3
"""What commands while its master is slow to say whether it knows the node, and what is left of it then."""
import os
import signal
import sys
import time

import rosgraph
import rospy
import rostest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, os.pardir, "security")]
import node_probes as probes  # noqa: E402
from commanders import COMMANDERS, DEADLINE, CommanderTest, RunningCommander  # noqa: E402
from own_master import start_own_master  # noqa: E402
from running_nodes import PACKAGE  # noqa: E402
from slow_master import SlowMaster  # noqa: E402

PATIENCE = 1.0  # s that the master is waited for
SLOW, LATE = 0.8 * PATIENCE, 1.3 * PATIENCE
MANY = 10**6  # questions


class EveryCommanderSlowMaster(CommanderTest):
    def ended(self, name, seconds, before=0):
        """A node that has ended while its master, but for `before` answers at once, took so long to say whether it knows it."""
        master = SlowMaster(rosgraph.get_master_uri(), seconds, MANY, method="lookupNode", before=before)
        self.addCleanup(master.end)
        node = RunningCommander(name, "process", self.clock, self.folder, master=master.uri)
        self.started.append(node)
        self.assertTrue(self.moves(node), "%s: %s" % (node, self.said(node)))
        asked = max(len(master.asked_at), before)
        self.assertTrue(probes.until(node, lambda: len(master.asked_at) > asked + 2, time.monotonic() + DEADLINE, every=0.01),
                        "%s asks no longer" % node)
        self.assertIsNotNone(node.end_processes(signal.SIGTERM), "%s does not end" % node)
        self.assertEqual([], node.known_names(), str(node))
        return node

    def test_one_that_is_slow_when_a_node_ends_keeps_none_of_its_names(self):
        """A node that is told after it gave its names back that the master does not know it is not to be registered again. What
        it was before was not seen to do so either."""
        for name in COMMANDERS:
            self.ended(name, SLOW)

    def test_one_that_answers_too_late_has_not_forgotten_a_node(self):
        """What was seen before: an answer that was late counted as one that the master does not know the node. It was registered
        again each time, and where that fell into its end, what was registered outlived it."""
        for name in COMMANDERS:
            node = self.ended(name, LATE, before=3)
            self.assertEqual(0, self.times_said(node, "does not know this node"), str(node))


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_slow_master")
    rostest.rosrun(PACKAGE, "every_commander_slow_master", EveryCommanderSlowMaster)
