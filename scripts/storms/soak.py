"""Surveys the site again and again, and watches the resident memory of all nodes.

Prints every half minute of simulated time what projected_map and all nodes together take. What is asked is the slope of
a straight line through each node's memory over the last two thirds of the time, and not before the survey's third
round, with the interval that holds it with a confidence of 95 %; neighbouring samples are alike, which widens it. Holds
where an hour of the wall clock and more grows by no more than HOURLY_GROWTH an hour; is *not run* where the interval is
wider than that, so that nobody knows. A shorter run fails only where it grew, surely, by more than LARGEST_GROWTH.

Time runs as fast as pictures are mapped, at most SPEED times: those that wait take memory that is no leak.
"""
import math
import os
import time

from ros_session import Mapping, Nodes, SessionFailed, Vehicle, set_simulator, share_file

from .session import Master, NotRun, Overrides, process_id, resident_mb

WATCHED = ("/projected_map", "/path_planner", "/survey/navigate_path", "/simulator")
ROUND_SECONDS = 135.0     # of simulated time, at the survey's speed
LARGEST_GROWTH = 0.03     # of a run of less than an hour, over all of the window
HOURLY_GROWTH = 0.01
SAMPLE_SECONDS = 10.0     # of simulated time
PRINTED = 3               # every so many samples
MOST_WAITING = 5          # pictures; of more, time runs slower
SPEED = 8.0               # simulated seconds in a second of the wall clock, if the machine allows


def write_round(folder):
    """The survey's lines without the descent at the end."""
    import yaml
    with open(share_file("config", "survey_waypoints.yaml")) as file:
        lines = [w for w in yaml.safe_load(file)["waypoints"] if w["position"]["z"] == 4.5]
    name = os.path.join(folder, "round.yaml")
    with open(name, "w") as file:
        yaml.safe_dump({"waypoints": lines}, file)
    return name


class Pace:
    """How fast simulated time runs: slower while pictures wait, then faster again."""

    def __init__(self):
        self.factor = SPEED

    def follow(self, waiting):
        factor = min(SPEED, self.factor * (0.8 if waiting > MOST_WAITING else 1.1))
        if abs(factor - self.factor) > 1e-9:
            set_simulator("real_time_factor", factor)
        self.factor = factor


def report(sample, mapping, factor):
    seconds, _, memory = sample
    print("storm: %5.0f s simulated, %6.1f MB of projected_map, %6.1f MB of all, %d pictures mapped, %d dropped, "
          "%.1f times real time" % (seconds, memory["/projected_map"], sum(memory.values()), mapping.count("inserted"),
                                    mapping.count("dropped"), factor), flush=True)


def watch(nodes, vehicle, mapping, seconds):
    """(simulated s, wall clock h, {node: MB}) every SAMPLE_SECONDS."""
    pids = {node: process_id(node) for node in WATCHED}
    begin, start, samples, pace = vehicle.now(), time.monotonic(), [], Pace()
    while not samples or samples[-1][0] < seconds:
        due = begin + SAMPLE_SECONDS * (len(samples) + 1)
        nodes.wait_until(lambda: vehicle.now() >= due, 600.0, "simulated time")
        vehicle.check_untouched()
        memory = {node: resident_mb(pid) for node, pid in pids.items()}
        if not all(memory.values()):
            raise SessionFailed("a node has ended")
        samples.append((vehicle.now() - begin, (time.monotonic() - start) / 3600.0, memory))
        if len(samples) % PRINTED == 0:
            report(samples[-1], mapping, pace.factor)
        pace.follow(mapping.count("received") - mapping.count("inserted") - mapping.count("dropped"))
    return samples


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


def verdict(samples):
    hours = samples[-1][1]
    kept = [sample for sample in samples if sample[0] >= 2 * ROUND_SECONDS and sample[1] >= hours / 3]
    if len(kept) < 10:
        raise SessionFailed("too short: two rounds take %.0f s" % (2 * ROUND_SECONDS))
    growth = {node: hourly_growth([(at, memory[node]) for _, at, memory in kept]) for node in WATCHED}
    text = "%.2f h at %.1f times real time: " % (hours, samples[-1][0] / 3600.0 / hours) + ", ".join(
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
    return text


def storm(minutes, folder, given):
    overrides = Overrides(folder, given)
    arguments = ["real_time_factor:=%g" % SPEED, "survey:=true", "survey_waypoints:=" + write_round(folder),
                 "survey_overrides:=" + overrides.write("navigate_path", "survey_navigate.yaml", loop=True)]
    os.environ["GRID_PATH_PLANNER_SAVE_FOLDER"] = os.path.join(folder, "kept")
    with Master(), Nodes("demo.launch", arguments, os.path.join(folder, "log"), own_master=False) as nodes:
        vehicle, mapping = Vehicle(nodes), Mapping(nodes)
        vehicle.wait_until_ready()
        nodes.wait_for_service("/projected_map/save_map")
        return verdict(watch(nodes, vehicle, mapping, 60.0 * minutes))
