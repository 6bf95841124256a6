"""Simulated time jumps back and forth: the simulator is killed, and starts again with another time and the vehicle
where it was. Holds if no other node ends, and after every jump the map and the path are of the new time, the vehicle
goes on and touches nothing; and if the node that drives it by itself says of each jump back that there was one."""
import os
import signal
import struct

from ros_session import SessionFailed

from .other_sessions import COMMANDED
from .session import BEGIN, BACK_SECONDS, process_id

JUMPS = (0.1, -2.0, 3600.0, -3600.0, 2e9, -1.9e9, -100.0)  # s
LEAST_BACK = 1.0  # s: of a shorter way back the node may see nothing, since the simulator takes a while to start
WORD = "ROS time went back by"


class Heartbeats:
    """The stamps of the map that came, s, each that of the newest cloud in it: of changes, and where nothing changes of
    heartbeats."""

    def __init__(self):
        import rospy
        self.stamps = set()
        self.subscriber = rospy.Subscriber("/projected_map_updates", rospy.AnyMsg, self.on_update)

    def on_update(self, message):
        """An OccupancyGridUpdate, which begins with its header; Debian has no map_msgs for Python."""
        _, seconds, nanoseconds = struct.unpack_from("<III", message._buff)  # pylint: disable=protected-access
        self.stamps.add(seconds + 1e-9 * nanoseconds)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.subscriber.unregister()


def times_said(demo):
    with open(demo.nodes.log_name, errors="replace") as file:
        return sum(WORD in line for line in file)


def is_new(demo, stamp, begin):
    """Whether it lies between `begin`, to which time jumped, and now."""
    return begin <= stamp <= demo.vehicle.now() + LEAST_BACK


def map_goes_on(demo, heartbeats, begin):
    """Whether clouds of the new time come into the map: one stamp alone could be of the time before."""
    return sum(is_new(demo, stamp, begin) for stamp in tuple(heartbeats.stamps)) >= 2


def jump(demo, seconds):
    import rospy
    pid, before, said = process_id("/simulator"), demo.vehicle.now(), times_said(demo)
    os.kill(pid, signal.SIGKILL)
    for name, value in zip(BEGIN, demo.vehicle.pose()):
        rospy.set_param("/simulator/" + name, value)
    to = min(max(1.0, before + seconds), 2e9)
    rospy.set_param("/simulator/start_time", to)
    demo.vehicle.stamp = None
    demo.nodes.wait_until(lambda: process_id("/simulator") not in (None, pid) and demo.vehicle.stamp,
                          BACK_SECONDS, "simulator")
    with Heartbeats() as heartbeats:
        demo.drive.goes_on()
        demo.nodes.wait_until(lambda: map_goes_on(demo, heartbeats, to), BACK_SECONDS,
                              "map of the time after a jump of %g s" % seconds)
    stamp = demo.drive.path.header.stamp.to_sec()
    if not is_new(demo, stamp, to):
        raise SessionFailed("after a jump of %g s to %.1f s a path is stamped %.1f" % (seconds, to, stamp))
    if to < before - LEAST_BACK:
        demo.nodes.wait_until(lambda: times_said(demo) > said, BACK_SECONDS,
                              "word that time went back by %g s" % -seconds)


def storm(rounds, folder, given, name):
    rounds = int(rounds)
    with COMMANDED[name](folder, given) as demo:
        demo.drive.goes_on()
        before = demo.pids()
        for number in range(rounds * len(JUMPS)):
            jump(demo, JUMPS[number % len(JUMPS)])
        ended = [node for node, pid in demo.pids().items() if pid != before[node] and node != "/simulator"]
        if ended:
            raise SessionFailed("these have ended: " + ", ".join(ended))
    return "%d jumps, after each map and path were of the new time, and the vehicle went on and touched nothing" % (
        rounds * len(JUMPS))
