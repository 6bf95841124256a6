#!/usr/bin/env python3
"""The whole study on a roscore of its own: survey, 3-D map, 2-D map, plan, waypoint file, drive.

    rosrun grid_path_planner demo_run.py [--rviz] [--speed FACTOR] [--out FOLDER]

A simulated vehicle replays config/survey_waypoints.yaml; its depth camera fills an octree, whose slice at
the vehicle's depth becomes the 2-D map. On that a path is planned, written as a waypoint file and driven.
Into FOLDER (default: out) go projected_map.yaml with its image, waypoints.yaml, path.png and the nodes' output,
demo.log. The picture is drawn by `grid_path plan` with the same map, ends and parameters; that its path is
the node's is checked. Exit code 0 only if nothing was touched, a path was found and its end was reached.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import time

from ros_session import (Mapping, Nodes, Planner, SessionFailed, Vehicle, executable, plan_rows, run_session,
                         set_simulator, share_file)

# x, y, z in m, yaw in rad, as the original study has them; the survey ends at the start.
START = (10.6115, -12.4845, 2.947, 2.464)
GOAL = (1.2191, 4.8549, 2.883, -1.478)
LARGEST_START_ERROR = 0.15    # m
LARGEST_ARRIVAL_ERROR = 0.1   # m
SURVEY_SECONDS = 1500.0       # of the wall clock, if nothing else ends it
DRIVE_SECONDS = 600.0
HELD_RATE = 0.01              # Hz: no picture for 100 simulated seconds


def flags(yaml_name):
    """Parameters of path_planner as flags of the command line, which has the same options."""
    import yaml
    with open(yaml_name) as file:
        parameters = yaml.safe_load(file)
    return [part for name, value in parameters.items()
            for part in ("--" + name.replace("_", "-"), str(value).lower())]


def draw(map_file, picture, statistics):
    """The picture, by the command line; checks that it found the node's path."""
    command = [executable("grid_path"), "plan", "--json", "--image", picture, "--map", map_file,
               "--start", ",".join(map(repr, START)), "--goal", ",".join(map(repr, GOAL))]
    command += flags(share_file("config", "demo_planner.yaml"))
    answer = subprocess.run(command, capture_output=True, text=True)
    if answer.returncode != 0:
        raise SessionFailed("grid_path plan: " + (answer.stderr or answer.stdout).strip())
    report = json.loads(answer.stdout)
    if abs(report["cost"] - statistics.cost) > 1e-9 * statistics.cost:
        raise SessionFailed("grid_path plan found a path of cost %r on the saved map, the node one of %r"
                            % (report["cost"], statistics.cost))


def survey(nodes, vehicle, mapping, map_file, largest_error=LARGEST_START_ERROR):
    """Drives the survey's waypoints and saves the map that comes of it; at its end the vehicle is, in truth, not farther than
    `largest_error` (m) from where it was sent. Returns the rows of the report."""
    begin = time.monotonic()
    seconds = vehicle.drive_file("/survey", share_file("config", "survey_waypoints.yaml"), SURVEY_SECONDS)
    if vehicle.distance(START) > largest_error:
        raise SessionFailed("the survey ended %.2f m from the start of the path" % vehicle.distance(START))
    set_simulator("camera_rate", HELD_RATE)  # the map that is saved is the one that is planned on
    mapping.wait_until_mapped(SURVEY_SECONDS)
    mapping.save(map_file)
    return [("survey", "%.1f m in %.0f s, %.0f s of the wall clock" % (
                vehicle.driven_m, seconds, time.monotonic() - begin)),
            ("depth pictures", "%d mapped, %d dropped" % (mapping.count("inserted"), mapping.count("dropped"))),
            ("octree", "%d nodes, %.0f MB" % (mapping.count("nodes"), mapping.count("bytes") / 1e6))]


def drive(vehicle, waypoints):
    driven = vehicle.driven_m
    seconds = vehicle.drive_file("", waypoints, DRIVE_SECONDS)
    x, y, z, yaw = vehicle.pose()
    return [("driven", "%.2f m in %.1f s" % (vehicle.driven_m - driven, seconds)),
            ("arrived at", "x %.3f  y %.3f  z %.3f m  yaw %.3f rad" % (x, y, z, yaw)),
            ("arrival error", "%.3f m, %.3f rad" % (
                vehicle.distance(GOAL), abs(math.remainder(yaw - GOAL[3], 2 * math.pi)))),
            ("touched", vehicle.contact.data if vehicle.contact else "nothing (%d contacts)"
             % vehicle.contacts.data)]


def prepared(folder):
    """Names of the results, none of which is there yet."""
    os.makedirs(folder, exist_ok=True)
    names = [os.path.join(folder, name) for name in ("path.png", "waypoints.yaml", "projected_map.yaml")]
    for name in names:
        if os.path.exists(name):
            os.remove(name)
    return names


def run(arguments):
    picture, waypoints, map_file = prepared(arguments.out)
    launch_arguments = ["rviz:=" + str(arguments.rviz).lower(), "real_time_factor:=%g" % arguments.speed,
                        "waypoints_file:=" + os.path.abspath(waypoints),
                        "save_folder:=" + os.path.abspath(arguments.out),
                        "load_folder:=" + os.path.abspath(arguments.out)]
    with Nodes("demo.launch", launch_arguments, os.path.join(arguments.out, "demo.log")) as nodes:
        print("demo: nodes start on %s" % os.environ["ROS_MASTER_URI"], flush=True)
        vehicle = Vehicle(nodes)
        mapping = Mapping(nodes)
        vehicle.wait_until_ready()
        nodes.wait_for_service("/projected_map/save_map")
        print("demo: the vehicle surveys the site", flush=True)
        rows = survey(nodes, vehicle, mapping, map_file)
        statistics, path = Planner(nodes, vehicle).plan(GOAL, START)
        rows += plan_rows(statistics, path)
        nodes.wait_until(lambda: os.path.exists(waypoints), 10.0, "waypoint file")
        print("demo: a path is found, the vehicle drives", flush=True)
        rows += drive(vehicle, waypoints)
        draw(map_file, picture, statistics)
        for row in rows:
            print("  %-14s %s" % row)
        if arguments.rviz and sys.stdin.isatty():
            input("demo: press Enter to close rviz ")
        error = vehicle.distance(GOAL)
        print("demo: status=%s length_m=%.3f arrival_error_m=%.3f contacts=%d picture=%s waypoints=%s map=%s" % (
            statistics.status, statistics.length_m, error, vehicle.contacts.data, picture, waypoints, map_file))
        vehicle.check_untouched()
        if error > LARGEST_ARRIVAL_ERROR:
            raise SessionFailed("the vehicle arrived %.3f m from the goal" % error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rviz", action="store_true", help="show it in rviz")
    parser.add_argument("--speed", type=float, default=8.0, metavar="FACTOR",
                        help="simulated seconds in a second of the wall clock, if the machine allows (default: 8)")
    parser.add_argument("--out", default="out", metavar="FOLDER", help="for the results (default: out)")
    run_session("demo", run, parser.parse_args())


if __name__ == "__main__":
    main()
