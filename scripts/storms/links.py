"""The vehicle is commanded over a link that is cut, late, and loses frames: the node that commands is on the other side of a
Wire than the master and all other nodes of its session.

By the wall clock, as on two machines: /clock would be as late as all else, so that to the node nothing was. Holds if the
vehicle stands within cmd_vel_timeout and its braking of a cut, stands while the link is late where the node knows the
age of what it hears (a joystick's is not known), drives on after every trouble without a new goal, touches nothing, and
the node does not end. After a cut that may take as much longer as it was cut: TCP tries again ever more seldom, after twice the
time of before, and nobody tells it that the link is back. *Not run* where namespaces or TAP devices may not be made.
"""
import time

from ros_session import SessionFailed

from .kills import CMD_VEL_TIMEOUT, STANDS
from .other_sessions import COMMANDED
from .session import BACK_SECONDS, process_id
from .wire import Wire

CUT_SECONDS, LATE_SECONDS, LOSS = 30.0, 2.0, 0.2
TROUBLE_SECONDS = 15.0  # of a link that is late or loses
SURE_SECONDS = 2.0      # until a pose or a cloud is too old for the nodes


def stands(demo, simulated_seconds):
    """Whether the vehicle stands so many of its seconds from now at the latest."""
    begin = demo.vehicle.now()
    demo.nodes.wait_until(lambda: demo.vehicle.speed() < STANDS or demo.vehicle.now() > begin + simulated_seconds,
                          BACK_SECONDS, "time")
    return demo.vehicle.speed() < STANDS


def watch(demo, seconds):
    """The most that the vehicle moves at in so many seconds of the wall clock, in which nothing is asked of it."""
    deadline, most = time.monotonic() + seconds, 0.0
    while time.monotonic() < deadline:
        demo.nodes.check()
        demo.vehicle.check_untouched()
        most = max(most, demo.vehicle.speed())
        time.sleep(0.05)
    return most


def be_cut(demo, wire):
    wire.is_cut = True
    stood = stands(demo, CMD_VEL_TIMEOUT + demo.BRAKING)
    most = watch(demo, CUT_SECONDS)
    wire.is_cut = False
    if not stood or most > STANDS:
        raise SessionFailed("the vehicle drives at %.2f while the link is cut" % most)


def be_late(demo, wire):
    wire.delay = LATE_SECONDS
    watch(demo, LATE_SECONDS + demo.BRAKING + SURE_SECONDS)  # commands of before are late, too
    if demo.KNOWS_AGES:
        demo.nodes.wait_until(lambda: demo.vehicle.speed() < STANDS, BACK_SECONDS, "stop while the link is late")
    most = watch(demo, TROUBLE_SECONDS)
    wire.delay = 0.0
    if demo.KNOWS_AGES and most > STANDS:
        raise SessionFailed("the vehicle drives at %.2f by what is %.0f s old" % (most, LATE_SECONDS))


def lose_frames(demo, wire):
    wire.loss = LOSS
    watch(demo, TROUBLE_SECONDS)
    wire.loss = 0.0


TROUBLES = {"a cut": be_cut, "lateness": be_late, "lost frames": lose_frames}


def suffer(demo, wire, took):
    """How far it drove while frames were lost, in m. `took`, by the trouble: s from its end until the vehicle drives on."""
    for name, trouble in TROUBLES.items():
        demo.drive.goes_on()
        begin = demo.vehicle.driven_m
        trouble(demo, wire)
        driven = demo.vehicle.driven_m - begin
        end = time.monotonic()
        try:
            goes_on = demo.drive.goes_on_unasked(seconds=BACK_SECONDS + (CUT_SECONDS if trouble is be_cut else 0.0))
        except SessionFailed as reason:
            raise SessionFailed("after %s: %s" % (name, reason)) from reason
        if not goes_on and not demo.drive.is_there():
            raise SessionFailed("the vehicle has not driven on by itself after " + name)
        took.setdefault(name, []).append(time.monotonic() - end)
    return driven


def prefix(wire):
    """By which a node runs on the other side."""
    return "ip netns exec %s env ROS_HOSTNAME=%s" % (wire.names[1], wire.addresses[1])


def storm(rounds, folder, given, name):
    session = COMMANDED[name]
    with Wire() as wire:
        wire.enter(0)
        with session(folder, given, commander=session.OVER_A_LINK,
                     arguments=["simulated_time:=false", "%s:=%s" % (session.PREFIX, prefix(wire))],
                     host=wire.addresses[0]) as demo:
            process = process_id(demo.COMMANDER)
            took = {}
            driven = [suffer(demo, wire, took) for _ in range(int(rounds))]
            if process_id(demo.COMMANDER) != process:
                raise SessionFailed("%s has ended" % demo.COMMANDER)
        return "%d times cut %.0f s, late %.0f s, losing %.0f %%: stood in time, went on by itself (%s), %.1f m driven while it lost" % (
            int(rounds), CUT_SECONDS, LATE_SECONDS, 100 * LOSS,
            ", ".join("%.1f s after %s" % (max(seconds), name) for name, seconds in took.items()), sum(driven))
