"""Surveys the site again and again, and watches the resident memory of all nodes.

Prints every half minute of simulated time what projected_map and all nodes together take. Holds if, from the second
round of the survey to the end, no node grows by more than the larger of LARGEST_GROWTH and 1 % for each hour of the
wall clock; over the last two thirds of an hour and more by the slope of a straight line alone.
"""
import os
import time

from ros_session import Mapping, Nodes, SessionFailed, Vehicle, share_file

from .session import Master, NotRun, Overrides, process_id, resident_mb

WATCHED = ("/projected_map", "/path_planner", "/survey/navigate_path", "/simulator")
ROUND_SECONDS = 135.0     # of simulated time, at the survey's speed
LARGEST_GROWTH = 0.03     # of a run of less than an hour
HOURLY_GROWTH = 0.01
SAMPLE_SECONDS = 30.0     # of simulated time
MOST_WAITING = 50         # pictures
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


def watch(nodes, vehicle, mapping, seconds):
    """(simulated s, wall clock h, {node: MB}) every SAMPLE_SECONDS."""
    pids = {node: process_id(node) for node in WATCHED}
    begin, start, samples = vehicle.now(), time.monotonic(), []
    while not samples or samples[-1][0] < seconds:
        due = begin + SAMPLE_SECONDS * (len(samples) + 1)
        nodes.wait_until(lambda: vehicle.now() >= due, 600.0, "simulated time")
        vehicle.check_untouched()
        memory = {node: resident_mb(pid) for node, pid in pids.items()}
        if not all(memory.values()):
            raise SessionFailed("a node has ended")
        samples.append((vehicle.now() - begin, (time.monotonic() - start) / 3600.0, memory))
        print("storm: %5.0f s simulated, %6.1f MB of projected_map, %6.1f MB of all, %d pictures mapped, %d dropped" % (
            samples[-1][0], memory["/projected_map"], sum(memory.values()), mapping.count("inserted"),
            mapping.count("dropped")), flush=True)
        waiting = mapping.count("received") - mapping.count("inserted") - mapping.count("dropped")
        if waiting > MOST_WAITING:  # their memory is no leak
            raise NotRun("%d pictures wait: the machine is too slow for %g times real time" % (waiting, SPEED))
    return samples


def slope(points):
    """Of the least squares' straight line through (x, y)."""
    x_mean, y_mean = (sum(values) / len(points) for values in zip(*points))
    spread = sum((x - x_mean) ** 2 for x, _ in points)
    return sum((x - x_mean) * (y - y_mean) for x, y in points) / spread


def verdict(samples):
    hours = samples[-1][1]
    kept = [sample for sample in samples if sample[0] >= 2 * ROUND_SECONDS and sample[1] >= hours / 3]
    if len(kept) < 3:
        raise SessionFailed("too short: two rounds take %.0f s" % (2 * ROUND_SECONDS))
    window = kept[-1][1] - kept[0][1]
    allowed = HOURLY_GROWTH * window if hours >= 1.0 else LARGEST_GROWTH
    growth = {node: slope([(at, memory[node]) for _, at, memory in kept]) * window / kept[0][2][node]
              for node in WATCHED}
    text = "%.2f h: " % hours + ", ".join("%s grew by %.2f %%" % (node, 100 * value) for node, value in growth.items())
    if max(growth.values()) > allowed:
        raise SessionFailed(text + ": more than %.2f %%" % (100 * allowed))
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
