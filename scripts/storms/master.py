"""The ROS master is killed during a drive, and started again, in rounds of a short and a long time without.

Holds if the vehicle drives on for the short time, stands before master_timeout and a little is over in the long one,
all topics and services are registered again within 5 s of a master that answers, the vehicle goes on by itself, and
cmd_vel is silent no longer than the law of silence.py allows while it drives.
"""
import time

from ros_session import SessionFailed

from .session import BACK_SECONDS, Demo, patience
from .silence import Silence

SHORT = 3.0             # s without a master
MASTER_TIMEOUT = 6.0    # s
REGISTERED_SECONDS = 5.0


def registered(demo):
    """(kind, name, node) of all that the demo's nodes have registered."""
    import rosgraph
    try:
        state = rosgraph.Master("/storm").getSystemState()
    except (rosgraph.MasterError, OSError):
        return set()
    return {(kind, name, node) for kind, entries in enumerate(state) for name, nodes in entries for node in nodes
            if node in demo.NODES}


def lose(demo, seconds):
    """The seconds that all names took to be there again, and how far the vehicle came meanwhile."""
    before, begin = registered(demo), demo.vehicle.driven_m
    demo.master.kill()
    demo.drive.seconds(seconds)
    driven = demo.vehicle.driven_m - begin
    demo.master.__enter__()
    back = time.monotonic()
    demo.nodes.wait_until(lambda: before <= registered(demo), patience(REGISTERED_SECONDS), "all names")
    return time.monotonic() - back, driven


def storm(rounds, folder, given):
    slowest, rounds = 0.0, int(rounds)
    with Demo(folder, given, navigate={"master_timeout": MASTER_TIMEOUT}) as demo, Silence() as silence:
        for _ in range(rounds):
            demo.drive.goes_on()
            silence.begin()
            seconds, driven = lose(demo, SHORT)
            silence.end()
            slowest = max(slowest, seconds)
            if driven < 0.3:
                raise SessionFailed("without a master for %.0f s the vehicle drove %.2f m" % (SHORT, driven))
            demo.drive.goes_on()
            seconds, _ = lose(demo, MASTER_TIMEOUT + 4.0)
            slowest = max(slowest, seconds)
            if demo.vehicle.speed() > 0.02 and not demo.drive.stood:
                raise SessionFailed("%.0f s without a master the vehicle drives" % (MASTER_TIMEOUT + 4.0))
            demo.nodes.wait_until(lambda: demo.vehicle.speed() > 0.05, patience(BACK_SECONDS), "motion")
        text = silence.verdict()
    return "%d times lost and back; all names there within %.1f s; %s" % (2 * rounds, slowest, text)
