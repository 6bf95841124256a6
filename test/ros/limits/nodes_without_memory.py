"""What the suites of nodes that lack memory have in common: their environment, and the story of a node that does not answer."""
import os
import signal
import sys
import tempfile
import time
import unittest

import rospkg

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, os.pardir, "security")]
import node_probes as probes  # noqa: E402
from running_nodes import PACKAGE, Clock, RunningNode, executable, is_sanitized, threads_of  # noqa: E402

SECONDS = 60.0  # for the start, for what is said, for a right answer


def skip_where_sanitized():
    if is_sanitized(executable("path_planner")):
        raise unittest.SkipTest("a sanitizer takes addresses, and an operator new, of its own")


def failing_allocations(switch, thread=None):
    """The environment of a node whose memory fails while there is the file `switch` (failing_allocations.cpp)."""
    library = os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", "libfailing_allocations.so")
    environment = dict(os.environ, LD_PRELOAD=library, FAILING_ALLOCATIONS=switch)
    if thread:
        environment["FAILING_ALLOCATIONS_THREAD"] = thread
    return environment


class NodesWithoutMemory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        skip_where_sanitized()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        os.environ["GRID_PATH_PLANNER_LOAD_FOLDER"] = os.path.join(rospkg.RosPack().get_path(PACKAGE), "test", "data")
        os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder.name, "saved")
        os.environ["ROSCONSOLE_STDOUT_LINE_BUFFERED"] = "1"
        cls.folder, cls.clock = folder.name, Clock(False)

    def started(self, name, row, kind="process"):
        node = RunningNode(name, row, kind, self.clock, self.folder)
        self.addCleanup(node.end, signal.SIGKILL)
        self.holds(probes.until(node, node.is_connected, time.monotonic() + SECONDS), node)
        self.holds(self.answers(node), node)
        return node

    @staticmethod
    def answers(node):
        return node.row.probe(node, time.monotonic() + SECONDS) and node.lives()

    def holds(self, done, node, what="at its start"):
        """Asks the debugger for the node's threads only where it does not."""
        if done:
            return
        with open(node.log.name, errors="replace") as log:
            self.fail("%s: %s, which %s; its log ends with: %s\nIts threads:\n%s" % (
                what, node.story(), "runs" if node.lives() else "has ended", log.read()[-1500:],
                "\n".join(threads_of(process) for process in node.processes)))
