"""Surveys the site, plans over it and drives there and back, again and again, and watches the resident memory of all nodes.

Prints every minute of the wall clock what projected_map and all nodes together take. What is asked is the slope of
a straight line through each node's memory over the last two thirds of the time, and not before the third
round, with the interval that holds it with a confidence of 95 %; neighbouring samples are alike, which widens it. Holds
where an hour and more grows by no more than HOURLY_GROWTH an hour; is *not run* where the interval is
wider than that, so that nobody knows. A shorter run fails only where it grew, surely, by more than LARGEST_GROWTH.

In the first survey projected_map is stopped a few times for STALL_SECONDS, so that as many pictures wait as may: its heap
keeps that size, and what grows later is no queue that was longer once because others had the processor.

Simulated time runs as fast as pictures are mapped, at most FASTEST times: those that wait take memory that is no leak.
An hour and more at less than SPEED times real time is *not run* either: the machine had no time for it.
"""
import math
import os
import signal
import threading
import time

from ros_session import Mapping, Nodes, SessionFailed, Vehicle, set_simulator, share_file

from .session import Drive, Master, NotRun, Overrides, process_id, resident_mb

WATCHED = ("/projected_map", "/path_planner", "/survey/navigate_path", "/navigate_path", "/simulator")
# From the survey's end, where a drive ends too, up and around to its beginning: x, y, z in m, yaw in rad.
WAY_BACK = ((13.5, -12.45, 4.0, 0.0), (16.65, -12.3, 4.5, math.pi / 2))
LARGEST_GROWTH = 0.03     # of a run of less than an hour, over all of the window
HOURLY_GROWTH = 0.01
SAMPLE_SECONDS = 2.0      # of the wall clock
PRINTED = 30              # every so many samples
STALLS = (20, 30, 40)     # before these samples
STALL_SECONDS = 2.5       # of the wall clock
MOST_WAITING = 5          # pictures; of more, time runs slower
SPEED, FASTEST = 8.0, 9.0  # simulated seconds in a second of the wall clock, if the machine allows
SURVEY_SECONDS = 6000.0   # of the wall clock, which only what hangs takes
DRIVE_SECONDS = 1200.0


def waypoint(x, y, z, yaw):
    return {"position": {"x": x, "y": y, "z": z},
            "orientation": {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}}


def write_surveys(folder):
    """The survey's waypoint file, and one that begins with the way back to it."""
    import yaml
    with open(share_file("config", "survey_waypoints.yaml")) as file:
        survey = yaml.safe_load(file)["waypoints"]
    names = [os.path.join(folder, name) for name in ("survey.yaml", "again.yaml")]
    for name, before in zip(names, ((), WAY_BACK)):
        with open(name, "w") as file:
            yaml.safe_dump({"waypoints": [waypoint(*pose) for pose in before] + survey}, file)
    return names


class Pace:
    """How fast simulated time runs: slower while pictures wait, then faster again."""

    def __init__(self):
        self.factor = FASTEST

    def follow(self, waiting):
        factor = min(FASTEST, self.factor * (0.8 if waiting > MOST_WAITING else 1.1))
        if abs(factor - self.factor) > 1e-9:
            set_simulator("real_time_factor", factor)
        self.factor = factor


def stall(pid):
    """As if others had the processor."""
    os.kill(pid, signal.SIGSTOP)
    try:
        time.sleep(STALL_SECONDS)
    finally:
        os.kill(pid, signal.SIGCONT)


class Watch(threading.Thread):
    """(round, wall clock h, {node: MB}) every SAMPLE_SECONDS, in a thread of its own."""

    def __init__(self, vehicle, mapping):
        super().__init__(daemon=True)
        self.vehicle, self.mapping, self.pace = vehicle, mapping, Pace()
        self.pids = {node: process_id(node) for node in WATCHED}
        self.samples, self.round, self.failure = [], 0, None
        self.begin, self.simulated_begin = time.monotonic(), vehicle.now()

    def hours(self):
        return (time.monotonic() - self.begin) / 3600.0

    def simulated_hours(self):
        return (self.vehicle.now() - self.simulated_begin) / 3600.0

    def check(self):
        if self.failure:
            raise SessionFailed(self.failure)

    def run(self):
        try:
            while not self.failure:
                if len(self.samples) in STALLS:
                    stall(self.pids["/projected_map"])
                self.sample()
                time.sleep(SAMPLE_SECONDS)
        except Exception as reason:  # else nobody would notice that it has ended
            self.failure = "no sample could be taken: %s" % reason

    def sample(self):
        memory = {node: resident_mb(pid) for node, pid in self.pids.items()}
        ended = [node for node, megabytes in memory.items() if not megabytes]
        if ended:
            self.failure = "these have ended: " + ", ".join(ended)
        self.samples.append((self.round, self.hours(), memory))
        if len(self.samples) % PRINTED == 0:
            self.report(memory)
        count = self.mapping.count
        self.pace.follow(count("received") - count("inserted") - count("dropped"))

    def report(self, memory):
        print("storm: %.2f h, round %d, %6.1f MB of projected_map, %6.1f MB of all, %d pictures mapped, %d dropped, "
              "%.1f times real time" % (
                  self.hours(), self.round, memory["/projected_map"], sum(memory.values()),
                  self.mapping.count("inserted"), self.mapping.count("dropped"), self.simulated_hours() / self.hours()),
              flush=True)


def there_and_back(nodes, drive, watch):
    """Between the ends of the study's path, each way by a plan of its own."""
    for end in (1, 0):
        drive.end = end
        drive.ask()

        def arrived():
            watch.check()
            drive.vehicle.check_untouched()
            return drive.vehicle.distance(drive.ends[end]) < 0.1 and drive.vehicle.speed() < 0.02
        nodes.wait_until(arrived, DRIVE_SECONDS, "end of a drive")


def run_rounds(nodes, vehicle, folder, hours):
    """The samples, and how often real time was run through."""
    watch, drive = Watch(vehicle, Mapping(nodes)), Drive(nodes, vehicle)
    set_simulator("real_time_factor", FASTEST)
    watch.start()
    survey, again = write_surveys(folder)
    while not watch.samples or watch.samples[-1][1] < hours:
        watch.check()
        vehicle.drive_file("/survey", again if watch.round else survey, SURVEY_SECONDS)
        there_and_back(nodes, drive, watch)
        watch.round += 1
    watch.check()
    return watch.samples, watch.simulated_hours() / watch.hours()


def slope(points):
    """Of the least squares' straight line through (x, y), and half the interval that holds it with a confidence of 95 %."""
    number = len(points)
    x_mean, y_mean = (sum(values) / number for values in zip(*points))
    spread = sum((x - x_mean) ** 2 for x, _ in points)
    rise = sum((x - x_mean) * (y - y_mean) for x, y in points) / spread
    rest = [y - y_mean - rise * (x - x_mean) for x, y in points]
    square = sum(value ** 2 for value in rest)
    if square == 0.0:
        return rise, 0.0
    alike = min(0.99, max(0.0, sum(a * b for a, b in zip(rest, rest[1:])) / square))
    independent = max(3.0, number * (1.0 - alike) / (1.0 + alike))
    freedom = independent - 2.0
    student = 1.96 + 2.37 / freedom + 2.8 / freedom ** 2
    return rise, student * math.sqrt(square / (number - 2) / independent / (spread / number))


def hourly_growth(points):
    """Shares of the mean."""
    mean = sum(y for _, y in points) / len(points)
    return tuple(value / mean for value in slope(points))


def verdict(samples, factor):
    hours = samples[-1][1]
    kept = [sample for sample in samples if sample[0] >= 2 and sample[1] >= hours / 3]
    if len(kept) < 10:
        raise SessionFailed("too short: %d rounds in %.2f h" % (samples[-1][0] + 1, hours))
    growth = {node: hourly_growth([(at, memory[node]) for _, at, memory in kept]) for node in WATCHED}
    text = "%.2f h, %d rounds, at %.1f times real time: " % (hours, samples[-1][0] + 1, factor) + ", ".join(
        "%s %+.2f ± %.2f %% an hour" % (node, 100 * rise, 100 * half) for node, (rise, half) in growth.items())
    if hours < 1.0:
        window = kept[-1][1] - kept[0][1]
        if max(rise - half for rise, half in growth.values()) * window > LARGEST_GROWTH:
            raise SessionFailed(text + ": more than %.0f %% in %.2f h" % (100 * LARGEST_GROWTH, window))
        return text
    if max(rise for rise, _ in growth.values()) > HOURLY_GROWTH:
        raise SessionFailed(text + ": more than %.0f %%" % (100 * HOURLY_GROWTH))
    if max(half for _, half in growth.values()) > HOURLY_GROWTH:
        raise NotRun(text + ": too uncertain")
    if factor < SPEED:
        raise NotRun(text + ": the machine was too slow")
    return text


def storm(hours, folder, given):
    overrides = Overrides(folder, given)
    arguments = ["survey_load_folder:=" + folder,
                 "navigate_overrides:=" + overrides.write("navigate_path", "demo_navigate.yaml", hold_pose=False)]
    os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder, "kept")
    with Master(), Nodes("demo.launch", arguments, os.path.join(folder, "log"), own_master=False) as nodes:
        vehicle = Vehicle(nodes)
        vehicle.wait_until_ready()
        for service in ("/projected_map/save_map", "/path_planner/make_plan"):
            nodes.wait_for_service(service)
        nodes.wait_until(lambda: all(map(process_id, WATCHED)), 60.0, "nodes")
        return verdict(*run_rounds(nodes, vehicle, folder, hours))
