#!/usr/bin/env python3
"""One vehicle has one commander: each pair of nodes that publish its velocities or offer the same action.

What was seen before: two navigate_paths drove one vehicle along two paths; two nodelets of one manager did so long after
two nodes could not, since the master knows both by the manager's name; on a busy machine a second's silence of the master
was taken for leave; and of two that started at once both stayed, since that with the earlier name took the other, which
had looked before, for one that would go. No test had shown that a node commands nothing before it knows to be alone.
"""
import os
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

import node_probes as probes
from commander_pairs import DRIVERS, PAIRS, PairTest
from commanders import COMMANDERS, DEADLINE, VELOCITIES, RunningCommander
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE
from slow_master import SlowMaster


class RegisteringMaster(SlowMaster):
    """Answers the first question who publishes what, and three others never. `registered_at`: when a topic of one of the
    types was registered first."""

    def __init__(self, types):
        self.types, self.registered_at = [kind.encode() for kind in types], None
        super().__init__(rosgraph.get_master_uri(), 2.0 * DEADLINE, 3, before=1)

    def is_lost(self, question):
        if not self.registered_at and b"registerPublisher" in question and any(kind in question for kind in self.types):
            self.registered_at = time.monotonic()
        return False


class EveryCommanderStart(PairTest):
    def test_of_two_that_start_at_once_one_at_most_stays(self):
        for first, second in [pair for pair in PAIRS if pair[0] in DRIVERS and pair[0] <= pair[1]]:
            node = self.started_node(first, "process")
            process = self.second(node, second)
            name = "%s/second_%s" % (node.space, second)
            both = [(node.processes[0], node.full_name()), (process, name)]

            def settled():
                return all(one.poll() is not None or self.is_up(full_name) for one, full_name in both)
            self.assertTrue(probes.until(self.anybody(), settled, time.monotonic() + DEADLINE), str(node))
            codes = [one.poll() for one, _ in both]
            self.assertTrue(any(code is not None and code != 0 for code in codes), "%s beside %s: %s: %s" % (
                second, node, codes, self.said(node)))
            node.end(signal.SIGKILL)

    def test_a_master_that_is_slow_to_answer_gives_no_leave(self):
        """As on a busy machine: it answers after two of the seconds that it is given."""
        for driver in DRIVERS:
            slow = SlowMaster(rosgraph.get_master_uri(), 2.0, 2)
            self.addCleanup(slow.end)
            self.refused(driver, driver, "process", slow.uri)

    def test_a_master_that_never_answers_gives_no_leave(self):
        node = self.first(DRIVERS[0], "process")
        silent = SlowMaster(rosgraph.get_master_uri(), 2.0 * DEADLINE, 1000)
        process = self.second(node, DRIVERS[0], silent.uri)
        self.ends_refused(node, process, "does not say whether another node commands the vehicle", DRIVERS[0])
        node.end(signal.SIGKILL)

    def test_nothing_is_commanded_before_the_master_has_said_that_it_is_alone(self):
        """It has asked once before its velocities are registered, and asks again then; three times nobody answers. What it is
        fed and offered would move the vehicle all the while."""
        for name in COMMANDERS:
            master = RegisteringMaster(VELOCITIES)
            self.addCleanup(master.end)
            node = RunningCommander(name, "process", self.clock, self.folder, master=master.uri)
            self.started.append(node)
            self.assertTrue(probes.until(node, lambda: node.moved_after(0.0), time.monotonic() + DEADLINE,
                                         lambda: node.table.offer(node), 0.3), "%s: %s" % (name, self.said(node)))
            node.end(signal.SIGKILL)
            begin = node.commands[0][0]
            self.assertTrue(any(master.registered_at < came and went < begin for came, went in master.answers),
                            "%s commanded after %.3f s: %s" % (name, begin - master.registered_at, self.said(node)))

    def test_one_that_comes_later_is_told(self):
        """Of this package or not; only navigate_path looked for it."""
        told = []
        listener = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda message: told.extend(message.status))
        self.addCleanup(listener.unregister)
        for name in COMMANDERS:
            node = self.first(name, "process")

            def says(level, words):
                del told[:]
                return probes.until(node, lambda: any(
                    status.name == node.full_name()[1:] + ": other nodes" and status.level == level and words in status.message
                    for status in list(told)), time.monotonic() + DEADLINE)
            self.assertTrue(says(DiagnosticStatus.OK, "nobody else"), str(node))
            topic = node.resolved(next(topic for topic, kind in NODES[name].outputs.items() if kind == VELOCITIES[0]))
            stranger = subprocess.Popen(["rostopic", "pub", topic, VELOCITIES[0], "{}"], stdout=node.log, stderr=subprocess.STDOUT)
            node.processes.append(stranger)
            self.assertTrue(says(DiagnosticStatus.ERROR, "publishes %s too" % topic), str(node))
            node.processes.remove(stranger)
            stranger.terminate()
            stranger.wait(DEADLINE)
            self.assertTrue(says(DiagnosticStatus.OK, "nobody else"), str(node))
            node.end(signal.SIGKILL)

    def test_the_master_forgets_what_was_killed(self):
        """By RunningNode.end(): its ports may be those of other tests' nodes a moment later."""
        for kind in ("process", "nodelet"):
            node = self.first(DRIVERS[0], kind)
            names = node.known_names()
            self.assertNotEqual([], names)
            node.end(signal.SIGKILL)
            self.assertEqual([], node.known_names(), kind)
            for name in names:
                self.assertRaises(rosgraph.MasterError, rosgraph.Master("/every_commander_start").lookupNode, name)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_start")
    rostest.rosrun(PACKAGE, "every_commander_start", EveryCommanderStart)
