"""The ROS master is killed during a drive, and started again, in rounds of a short and a long time without.

Holds if the vehicle drives on for the short time, stands before master_timeout and a little is over in the long one, but
where a hand at the joystick drives it, all topics and services are registered again within 5 s of a master that answers,
the vehicle goes on by itself, and cmd_vel is silent no longer than the law of silence.py allows while it drives.
"""
import time

from ros_session import SessionFailed

from .other_sessions import COMMANDED
from .session import BACK_SECONDS
from .silence import Silence

SHORT = 4.0             # s without a master
LONG = 10.0             # the same, longer than a session's MASTER_TIMEOUT
MOVING = 0.05           # m/s and rad/s


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
    """The seconds that all names took to be there again, and the vehicle's speed at the end of the time without."""
    before = registered(demo)
    demo.master.kill()
    demo.drive.seconds(seconds)
    speed = demo.vehicle.speed()
    demo.master.__enter__()
    back = time.monotonic()
    demo.nodes.wait_until(lambda: before <= registered(demo), BACK_SECONDS, "all names")
    return time.monotonic() - back, speed


def storm(rounds, folder, given, name):
    slowest, rounds, session = 0.0, int(rounds), COMMANDED[name]
    timeout = {"master_timeout": session.MASTER_TIMEOUT} if session.MASTER_TIMEOUT else {}
    with session(folder, given, commander=timeout) as demo, Silence(session.TICK) as silence:
        for _ in range(rounds):
            demo.drive.goes_on()
            silence.begin()
            seconds, speed = lose(demo, SHORT)
            silence.end()
            slowest = max(slowest, seconds)
            if speed < MOVING:
                raise SessionFailed("without a master for %.0f s the vehicle stands" % SHORT)
            demo.drive.goes_on()
            seconds, speed = lose(demo, LONG)
            slowest = max(slowest, seconds)
            if (speed > MOVING) == bool(timeout):
                raise SessionFailed("%.0f s without a master the vehicle moves at %.2f" % (LONG, speed))
            demo.nodes.wait_until(lambda: demo.vehicle.speed() > MOVING, BACK_SECONDS, "motion")
        text = silence.verdict()
    return "%d times lost and back; all names there within %.1f s; %s" % (2 * rounds, slowest, text)
