"""The vehicle is commanded over a link that is cut, late, and loses frames: master, simulator, mapping and planner on
one side of a Wire, navigate_path on the other.

Holds if the vehicle stands within cmd_vel_timeout and its braking of a cut, drives on after every trouble on the path that
it had, touches nothing, and no node ends. While the link is late it drives: /clock is as late as tf, so that to the
driver nothing is, which by the clocks of two machines it would be. *Not run* where namespaces or TAP devices may not be made.
"""
import math
import os
import subprocess
import time

from ros_session import START_SECONDS, SessionFailed, executable

from .kills import CMD_VEL_TIMEOUT, STANDS
from .session import ABOVE, ENDS, Demo, patience, process_id
from .wire import Wire

CUT_SECONDS, LATE_SECONDS, LOSS = 30.0, 2.0, 0.2
TROUBLE_SECONDS = 15.0  # of a link that is late or loses
DRIVER = "/shore/navigate_path"


class Driver:
    """navigate_path on the other side of the wire."""

    def __init__(self, wire, log):
        environment = dict(os.environ, ROS_HOSTNAME=wire.addresses[1])
        self.process = subprocess.Popen(
            ["ip", "netns", "exec", wire.names[1], executable("navigate_path"), "__ns:=shore", "cmd_vel:=/cmd_vel",
             "path:=/path", "projected_map:=/projected_map", "projected_map_updates:=/projected_map_updates",
             "_share_cmd_vel:=true", "_tf_timeout:=1.0", "_no_progress_timeout:=0"],
            env=environment, stdout=log, stderr=subprocess.STDOUT)

    def stop(self):
        self.process.kill()
        self.process.wait()


def stands(demo, simulated_seconds):
    """Whether the vehicle stands so many simulated seconds from now at the latest."""
    begin = demo.vehicle.now()
    demo.nodes.wait_until(lambda: demo.vehicle.speed() < STANDS or demo.vehicle.now() > begin + simulated_seconds,
                          patience(60.0), "simulated time")
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
    watch(demo, TROUBLE_SECONDS)
    wire.delay = 0.0


def lose_frames(demo, wire):
    wire.loss = LOSS
    watch(demo, TROUBLE_SECONDS)
    wire.loss = 0.0


def suffer(demo, wire):
    """How far it drove while frames were lost, in m."""
    for trouble in (be_cut, be_late, lose_frames):
        demo.drive.goes_on()
        begin = demo.vehicle.driven_m
        trouble(demo, wire)
        driven = demo.vehicle.driven_m - begin
        if not demo.drive.goes_on_unasked() and not demo.drive.is_there():
            raise SessionFailed("the vehicle has not driven on by itself")
    return driven


def keep_quiet(folder):
    """Parameters and arguments by which the demo's own navigate_path drives to where the vehicle is, and no more."""
    with open(os.path.join(folder, "stay.yaml"), "w") as file:
        file.write("waypoints:\n  - position: {x: %g, y: %g, z: %g}\n    orientation: {x: 0, y: 0, z: %g, w: %g}\n" % (
            ENDS[0][0], ENDS[0][1], ABOVE, math.sin(ENDS[0][3] / 2), math.cos(ENDS[0][3] / 2)))
    return {"config_filename": "stay.yaml", "hold_pose": False, "check_map": False}, ["load_folder:=" + folder]


def storm(rounds, folder, given):
    navigate, arguments = keep_quiet(folder)
    with Wire() as wire:
        wire.enter(0)
        with Demo(folder, given, host=wire.addresses[0], commander=navigate, arguments=arguments) as demo, \
                open(os.path.join(folder, "driver"), "w") as log:
            driver = Driver(wire, log)
            try:
                demo.nodes.wait_until(lambda: process_id(DRIVER), START_SECONDS, DRIVER)
                driven = [suffer(demo, wire) for _ in range(int(rounds))]
                if driver.process.poll() is not None:
                    raise SessionFailed("navigate_path has ended")
            finally:
                driver.stop()
        return "%d times cut %.0f s, late %.0f s, losing %.0f %%: stood in time, went on by itself, %.1f m driven while it lost" % (
            int(rounds), CUT_SECONDS, LATE_SECONDS, 100 * LOSS, sum(driven))
