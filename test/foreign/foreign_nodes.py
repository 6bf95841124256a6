"""Nodes that are fed with what other programs publish; a RunningNode of ../ros/security, whose transforms a row may change."""
import os
import re
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ros", "security"))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ros", "support"))
import table
from message_classes import message_class
from node_table import Row
from right_messages import of
from running_nodes import Clock, RunningNode

PATIENCE = 60.0  # s, for what has to come; only what hangs takes so long


def wait_until(holds, seconds=PATIENCE, send=lambda: None, every=0.5):
    """The last answer of `holds`, which is true, or came after that time."""
    end, due = time.monotonic() + seconds, 0.0
    while True:
        if time.monotonic() > due:
            send()
            due = time.monotonic() + every
        answer = holds()
        if answer or time.monotonic() > end:
            return answer
        time.sleep(0.02)


class ForeignNode(RunningNode):
    """`frames`: child: {parent, x, y, z, quaternion, stamp}, which are sent 20 times a second."""

    def __init__(self, name, row, log_folder, space=None, environment=None, at=(0.0, 0.0)):
        self.place(*at)
        self.transforms_sent = 0
        self.environment = environment
        self.marked = 0
        self.begun = None  # what the stamp `frozen` is
        super().__init__(name, row, "process", Clock(False), log_folder, space or "/" + name)

    def transforms(self, stamp):
        message = message_class("tf2_msgs/TFMessage")()
        self.begun = self.begun or stamp
        self.transforms_sent += 1
        for child, frame in list(self.frames.items()):
            x, y, z, w = frame.get("quaternion", (0.0, 0.0, 0.0, 1.0))
            at = self.begun if frame.get("stamp") == "frozen" else table.time_of(frame.get("stamp", "now"), stamp)
            message.transforms.append(of(
                "geometry_msgs/TransformStamped", child_frame_id=child,
                header={"frame_id": frame["parent"], "stamp": {"secs": at.secs, "nsecs": at.nsecs}},
                transform={"translation": {"x": frame.get("x", 0.0), "y": frame.get("y", 0.0), "z": frame.get("z", 0.0)},
                           "rotation": {"x": x, "y": y, "z": z, "w": w}}))
        return message

    def place(self, x=0.0, y=0.0, others=None):
        """The vehicle in the map, and other frames."""
        self.frames = dict({"base_link": {"parent": "map", "x": x, "y": y}}, **(others or {}))

    def settle(self):
        """What was placed elsewhere is known there, and a drive that begins now sees no jump."""
        sent = self.transforms_sent
        wait_until(lambda: self.transforms_sent > sent + 10)

    def said(self, since=0):
        with open(self.log.name, errors="replace") as file:
            file.seek(since)
            return file.read()

    def mark(self):
        self.marked = os.path.getsize(self.log.name)

    def says(self, sentence, since=None):
        """Whether its log has it, since mark()."""
        return re.search(sentence, self.said(self.marked if since is None else since)) is not None

    def times_said(self, sentence):
        return len(re.findall(sentence, self.said()))

    def starts(self):
        return wait_until(lambda: self.is_connected() or not self.lives()) and self.lives()


class ForeignTest(unittest.TestCase):
    kind = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        os.environ["GRID_PATH_PLANNER_LOAD_FOLDER"] = os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = cls.folder.name
        cls.now = Clock(False).now

    def node(self, name, row, **more):
        node = ForeignNode(name, row, self.folder.name, **more)
        self.addCleanup(node.end, 9)
        self.assertTrue(node.starts(), "%s does not start: %s" % (name, node.said()))
        return node

    def each(self, taker, ask, rows=None):
        """`ask(row, expected)` returns what is wrong, or nothing. A row that is open for this taker has to be wrong."""
        wrong, opened = [], []
        for row in table.rows(self.kind) if rows is None else rows:
            if table.expected(row, taker) is None or taker in row["expect"].get("not", []):
                continue
            found = ask(row, table.expected(row, taker))
            if taker in row.get("open", {}):
                opened.append("%s: %s" % (row["id"], found))
                if not found:
                    wrong.append("%s is right now for %s: take it off `open`" % (row["id"], taker))
            elif found:
                wrong.append("%s: %s" % (row["id"], found))
                print(taker, wrong[-1], flush=True)  # now: the rest may take long
        for line in opened:
            print("%s, not right yet: %s" % (taker, line))
        self.assertEqual([], wrong, "\n" + "\n".join(wrong))
