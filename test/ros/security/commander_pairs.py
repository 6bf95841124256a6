"""Two nodes of which both command the same vehicle, or offer the same action."""
import os
import signal
import subprocess
import time

import node_probes as probes
import rosgraph
from commanders import COMMANDERS, DEADLINE, VELOCITIES, CommanderTest
from node_table import NODES
from running_nodes import PACKAGE, RunningNode, executable, nodelet_program

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


PAIRS = [(first, second) for first in NODES for second in NODES if conflict(first, second)]


class PairTest(CommanderTest):
    """A node that is to be alone, and a second one beside it."""

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
        services = rosgraph.Master("/commander_pairs").getSystemState()[2]
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
