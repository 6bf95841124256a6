"""A ROS master of the test's own, in the session of the test and its nodes.

What was seen before: Linux shares its processors among sessions (sched_autogroup_enabled) and, in 6.18, may leave a
session without any for ten seconds while a thread of another spins, as roscpp's main thread does while it shuts down.
rostest's master is in another session than the test, so that it answered nobody for so long, and a nodelet manager that
waited for its answer was told to end too slowly.
"""
import atexit
import os
import subprocess
import sys
import time

import rosgraph

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "scripts"))
from ros_session import START_SECONDS, free_port  # noqa: E402


def start_own_master():
    """With the parameters of the one before. Everything asks it from here on; it ends with this process."""
    parameters = rosgraph.Master("/own_master").getParam("/")
    port = free_port()
    process = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL)
    atexit.register(process.kill)
    os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % port
    deadline = time.monotonic() + START_SECONDS
    while process_of_master() != process.pid:  # another test may have taken the port meanwhile
        if process.poll() is not None or time.monotonic() > deadline:
            raise RuntimeError("no ROS master of this test on port %d" % port)
        time.sleep(0.05)
    rosgraph.Master("/own_master").setParam("/", parameters)


def process_of_master():
    """None where nobody answers."""
    try:
        return rosgraph.Master("/own_master").getPid()
    except OSError:
        return None
