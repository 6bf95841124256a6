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
from commanders import COMMANDERS, DEADLINE, VELOCITIES, CommanderTest, RunningCommander
from node_table import NODES
from own_master import start_own_master
from running_nodes import PACKAGE, RunningNode, executable, nodelet_program
from slow_master import SlowMaster

DRIVERS = [name for name in COMMANDERS if "manual_control" in NODES[name].inputs]


def commands(name):
    """The topics of velocities and the actions that nobody else may command or offer."""
    row = NODES[name]
    return {topic for topic, kind in row.outputs.items() if kind in VELOCITIES} | set(row.actions)


def is_joystick(name):
    return "joy" in NODES[name].inputs


def conflict(first, second):
    """What both command, but for a driver and a joystick, to which it yields."""
    return commands(first) & commands(second) if is_joystick(first) == is_joystick(second) else set()


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


PAIRS = [(first, second) for first in NODES for second in NODES if conflict(first, second)]


class EveryCommanderStart(CommanderTest):
    def started_node(self, name, kind):
        """In a namespace of its own."""
        row = NODES[name]._replace(arguments=COMMANDERS[name].arguments if name in COMMANDERS else NODES[name].arguments)
        space = "/%s_%d" % (self.id().rsplit(".", 1)[1], len(self.started))
        self.started.append(RunningNode(name, row, kind, self.clock, self.folder, space))
        return self.started[-1]

    def first(self, name, kind):
        """A node that is to be alone, all there."""
        node = self.started_node(name, kind)
        self.assertTrue(probes.until(node, lambda: self.is_up(node.full_name()), time.monotonic() + DEADLINE),
                        "%s: %s" % (node, self.said(node)))
        return node

    @staticmethod
    def is_up(name):
        """Whether it offers what a node offers last of all when it starts."""
        services = rosgraph.Master("/every_commander_start").getSystemState()[2]
        return any(service == name + "/set_parameters" for service, _ in services)

    @staticmethod
    def second(node, name, master=None):
        """Started beside it, in its namespace and, of nodelets, its manager."""
        words = ["__ns:=" + node.space, "__name:=second_" + name]
        if node.kind == "process":
            command = [executable(name)] + words
        else:
            command = [nodelet_program(), "load", "%s/%s" % (PACKAGE, name), "manager", "--no-bond"] + words
        environment = dict(os.environ, ROS_MASTER_URI=master) if master else None
        process = subprocess.Popen(command, stdout=node.log, stderr=subprocess.STDOUT, env=environment)
        node.processes.append(process)
        return process

    def ends_refused(self, node, process, sentence, name):
        """Neither the log nor a status says that it runs: it has ended with an error and the sentence."""
        try:
            code = process.wait(DEADLINE)
        except subprocess.TimeoutExpired:
            self.fail("%s runs beside %s: %s" % (name, node, self.said(node)))
        node.processes.remove(process)
        self.assertNotEqual(0, code, "%s beside %s: %s" % (name, node, self.said(node)))
        self.assertRegex(self.said(node), sentence, "%s beside %s" % (name, node))
        self.assertTrue(node.lives(), str(node))

    def refused(self, first, second, kind, master=None):
        node = self.first(first, kind)
        process = self.second(node, second, master)
        self.ends_refused(node, process, "the node %s (publishes|offers) " % node.full_name(), second)
        node.end(signal.SIGKILL)

    def test_a_second_process_is_refused_and_names_the_first(self):
        for first, second in PAIRS:
            self.refused(first, second, "process")

    def test_a_second_nodelet_of_a_manager_is_refused_and_names_the_first(self):
        for first, second in PAIRS:
            self.refused(first, second, "nodelet")

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

    def test_a_joystick_and_a_driver_stand_beside_each_other(self):
        for driver in DRIVERS:
            for kind in ("process", "nodelet"):
                for first, second in ((driver, "teleop_joy"), ("teleop_joy", driver)):
                    node = self.first(first, kind)
                    process = self.second(node, second)
                    name = "%s/second_%s" % (node.space, second)
                    self.assertTrue(probes.until(node, lambda: self.is_up(name), time.monotonic() + DEADLINE),
                                    "%s beside %s: %s" % (second, node, self.said(node)))
                    self.assertIsNone(process.poll() if kind == "process" else None)
                    node.end(signal.SIGKILL)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_commander_start")
    rostest.rosrun(PACKAGE, "every_commander_start", EveryCommanderStart)
