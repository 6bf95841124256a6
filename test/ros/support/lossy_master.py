#!/usr/bin/env python3
"""Between nodes and their ROS master: loses the first questions of each registration and name, and those for the run,
while a file exists.

    lossy_master.py http://localhost:20001 20002 /tmp/lossy    # nodes have ROS_MASTER_URI=http://localhost:20002
"""
import collections
import os
import signal
import sys
import xmlrpc.client

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "security"))
from slow_master import SlowMaster  # noqa: E402

LOST = 4  # a client of roscpp asks twice


class LossyMaster(SlowMaster):
    def __init__(self, master, port, switch):
        self.switch, self.asked = switch, collections.Counter()
        super().__init__(master, 0.0, 0, port=port)

    def is_lost(self, question):
        arguments, method = xmlrpc.client.loads(question)
        asks_for_run = method in ("getParam", "hasParam") and arguments[1] == "/run_id"
        if not (method.startswith("register") or asks_for_run) or not os.path.exists(self.switch):
            return False
        with self.lock:
            self.asked[method, arguments[:2]] += 1
            return self.asked[method, arguments[:2]] <= LOST


LossyMaster(sys.argv[1], int(sys.argv[2]), sys.argv[3])
signal.pause()
