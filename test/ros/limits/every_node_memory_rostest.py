#!/usr/bin/env python3
"""A message for which there is not enough memory ends no node, and right data is answered afterwards.

Every node of node_table.py hears each of its topics whose messages have a size, by one that is right but too large: roscpp can
receive it, and what is made of it does not fit. What roscpp takes before that is not ours, and ends a node where it fails.
"""
import os
import resource
import signal
import subprocess
import sys
import time

import rospy
import rostest
from roslib.message import get_service_class

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from nodes_without_memory import PACKAGE, SECONDS, NodesWithoutMemory, RunningNode, executable, probes  # noqa: E402
from hostile_messages import serialized  # noqa: E402
from large_messages import LARGE, has_size, large  # noqa: E402
from node_table import NODES  # noqa: E402
from own_master import start_own_master  # noqa: E402

SIZE = 160 << 20  # bytes of a message
# Of a message's size, what there is beside it as it came: too little to unpack it; enough for that, and little for what is made of it.
# In this order: a node that is still at work on the second takes more than it had when the room was measured.
ROOM = (0.8, 1.3)
SAID = ("not enough memory", "bad_alloc")


def address_space(pid):
    with open("/proc/%d/status" % pid) as file:
        return next(int(line.split()[1]) << 10 for line in file if line.startswith("VmSize:"))


def limit(pid, size=None):
    """None: no more than it began with. The hard limit stays, since whoever raises it needs a privilege."""
    most = resource.prlimit(pid, resource.RLIMIT_AS)[1]
    resource.prlimit(pid, resource.RLIMIT_AS, (most if size is None else size, most))


class EveryNodeMemory(NodesWithoutMemory):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        os.environ["MALLOC_ARENA_MAX"] = "1"  # or each thread's first allocation takes 128 MB of addresses for a while
        cls.map_publisher = NODES["map_publisher"]._replace(
            arguments=["_filename:=large.yaml", "--load-folder", cls.folder])

    def test_every_type_with_a_size_has_a_large_message(self):
        node = RunningNode("teleop_joy", NODES["teleop_joy"], "process", self.clock, self.folder, "/types")
        self.addCleanup(node.end, signal.SIGKILL)
        kinds = {kind for row in NODES.values() for kind in row.inputs.values()}
        lacking = [kind for kind in kinds if has_size(kind, node.right(kind)) and kind not in LARGE]
        self.assertEqual(lacking, [])

    def test_every_node_goes_on(self):
        for name, row in NODES.items():
            node = self.started(name, row)
            topics = [(topic, kind) for topic, kind in node.fed() if kind in LARGE]
            for topic, kind in topics:
                node = node or self.started(name, row)
                for room in ROOM:
                    self.goes_on_after(node, topic, large(node, kind, SIZE), room)
                node = node.end(signal.SIGKILL) and None  # what it has kept of the message counts in no other's room

    def goes_on_after(self, node, topic, message, room):
        size, pid = len(serialized(message)), node.processes[0].pid
        with open(node.log.name, errors="replace") as log:
            log.seek(0, os.SEEK_END)
            limit(pid, address_space(pid) + int(size * (1.0 + room)))
            node.send(topic, message)
            said = []
            if room < 1.0:
                self.holds(probes.until(node, lambda: self.says(log, said), time.monotonic() + SECONDS), node, topic)
            self.holds(self.answers(node), node, "after %s with room for %g of its size" % (topic, room))
        limit(pid)

    def test_a_map_that_cannot_be_answered_with_is_no_end(self):
        side = 4000  # cells
        self.write_map(side)
        node = RunningNode("map_publisher", self.map_publisher, "process", self.clock, self.folder, "/serves")
        self.addCleanup(node.end, signal.SIGKILL)
        request, pid = get_service_class("nav_msgs/GetMap")._request_class(), node.processes[0].pid
        self.holds(probes.until(node, lambda: node.call("static_map", request), time.monotonic() + SECONDS), node)
        limit(pid, address_space(pid) + side * side // 2)  # of the answer, and what is sent of it
        self.assertIsNone(node.call("static_map", request))
        limit(pid)
        answer = node.call("static_map", request)
        self.holds(answer is not None and len(answer.map.data) == side * side, node)

    def test_a_large_map_is_sent_from_huge_pages(self):
        """A latched one is kept as it was sent, in an array of roscpp's (src/nodes/memory)."""
        self.write_map(4000)
        node = RunningNode("map_publisher", self.map_publisher, "process", self.clock, self.folder, "/sends")
        self.addCleanup(node.end, signal.SIGKILL)
        self.holds(probes.until(node, lambda: node.heard("projected_map"), time.monotonic() + SECONDS), node)
        with open("/proc/%d/smaps" % node.processes[0].pid) as file:
            self.assertTrue(any(line.startswith("VmFlags:") and "hg" in line.split() for line in file))

    def test_a_map_file_that_does_not_fit_ends_the_start_in_a_sentence(self):
        side = 10000  # cells
        self.write_map(10)
        few = self.started("map_publisher", self.map_publisher)
        base = address_space(few.processes[0].pid)
        few.end(signal.SIGKILL)
        self.write_map(side)
        for copies in (0.5, 1.5, 2.5):
            process = subprocess.run([executable("map_publisher")] + self.map_publisher.arguments, timeout=SECONDS, stderr=subprocess.PIPE,
                                     universal_newlines=True, preexec_fn=lambda: limit(0, base + int(copies * side * side)))
            self.assertEqual(process.returncode, 1, process.stderr)
            self.assertIn("map_publisher ends: ", process.stderr)

    def write_map(self, side):
        with open(os.path.join(self.folder, "large.pgm"), "wb") as file:
            file.write(b"P5\n%d %d\n255\n" % (side, side))
            file.truncate(file.tell() + side * side)
        with open(os.path.join(self.folder, "large.yaml"), "w") as file:
            file.write("image: large.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n")

    @staticmethod
    def says(log, said, texts=SAID):
        said.append(log.read())
        return any(text in "".join(said) for text in texts)


if __name__ == "__main__":
    start_own_master()
    rospy.init_node("every_node_memory")
    rostest.rosrun(PACKAGE, "every_node_memory", EveryNodeMemory)
