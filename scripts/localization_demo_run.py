#!/usr/bin/env python3
"""A drive on an estimated pose, on a roscore of its own: planned on the shipped map, to a pose before the testing panel.

    rosrun grid_path_planner localization_demo_run.py [--rviz] [--seed N] [--survey] [--out FOLDER] [--record]

Nobody tells the vehicle where it is: vehicle_localizer estimates it by IMU, DVL, pressure and acoustic fixes, and by the
panel's markers once the camera sees them. With --survey it maps the site first, on its estimate, and plans on that map, which
is projected_map.yaml then; how many cells differ from the shipped one is told. Into FOLDER (default: out) go waypoints.yaml and the nodes' output,
localization_demo.log; with --record also navigation_<time>.bag: what vehicle_localizer heard, and the truth. The table
says how far the estimate was from the truth, and whether the ellipse that the estimate gives itself, 95 % of a plane, holds
the truth at the end. Exit code 0 only if nothing was touched and the vehicle is, in truth, where it was sent.
"""
import argparse
import math
import os
import re
import sys

import demo_run
from ros_session import START_SECONDS, Mapping, Nodes, Planner, SessionFailed, Vehicle, plan_rows, run_session, share_file

GOAL = (4.66, -1.92, 2.9, 1.99)  # x, y, z in m, yaw in rad: 1.5 m before the panel, looking at it
LARGEST_ARRIVAL_ERROR = 0.25     # m, of the true pose
DRIVE_SECONDS = 600.0            # of the wall clock
LARGEST_SURVEY_ERROR = 0.5       # m, of the true pose at the end of the survey
ELLIPSE_95 = 5.991               # chi squared of two coordinates
KEPT_SECONDS = 5.0               # of truth, for estimates that come late


class Localization:
    """Hears what the localizer says of itself, and compares its estimates with the truth of the same stamps."""

    def __init__(self, nodes, vehicle):
        import rospy
        from geometry_msgs.msg import PoseWithCovarianceStamped
        from nav_msgs.msg import Odometry
        from std_msgs.msg import String
        self.nodes, self.vehicle = nodes, vehicle
        self.status, self.estimate = "nothing", None
        self.truths, self.errors, self.marker_fixes = {}, [], 0
        rospy.Subscriber("localization_status", String, lambda m: setattr(self, "status", m.data))
        rospy.Subscriber("ground_truth", Odometry, self.on_truth)
        rospy.Subscriber("odometry/filtered", Odometry, self.on_estimate)
        rospy.Subscriber("marker_pose", PoseWithCovarianceStamped, self.on_marker_fix)

    def on_truth(self, message):
        now = message.header.stamp.to_sec()
        self.truths[message.header.stamp.to_nsec()] = message
        for stamp in [stamp for stamp in list(self.truths) if stamp * 1e-9 < now - KEPT_SECONDS]:
            self.truths.pop(stamp, None)

    def on_marker_fix(self, _):
        self.marker_fixes += 1

    def on_estimate(self, message):
        self.estimate = message
        truth = self.truths.get(message.header.stamp.to_nsec())
        if truth is not None:
            self.errors.append((distance(message, truth), ellipse(message, truth)))

    def wait_until_known(self):
        self.nodes.wait_until(lambda: self.status.startswith("OK") and self.errors, START_SECONDS,
                              "pose that localization_status calls OK")

    def rows(self):
        metres = [error[0] for error in self.errors]
        return [("estimate", "%.3f m off on average, %.3f at most, of %d" % (
                    sum(metres) / len(metres), max(metres), len(metres))),
                ("marker fixes", "%d" % self.marker_fixes),
                ("says", "%.3f m" % standard_deviation(self.estimate))]


def distance(estimate, truth):
    a, b = estimate.pose.pose.position, truth.pose.pose.position
    return math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))


def standard_deviation(estimate):
    """Of the position, along x, y and z together."""
    c = estimate.pose.covariance
    return math.sqrt(c[0] + c[7] + c[14])


def ellipse(estimate, truth):
    """The squared distance in the plane, in variances of the estimate."""
    p, q, c = estimate.pose.pose.position, truth.pose.pose.position, estimate.pose.covariance
    x, y = p.x - q.x, p.y - q.y
    xx, xy, yy = c[0], c[1], c[7]
    return (yy * x * x - 2.0 * xy * x * y + xx * y * y) / (xx * yy - xy * xy)


def arrival_rows(vehicle, localization):
    position = localization.estimate.pose.pose.position
    by_estimate = math.dist((position.x, position.y, position.z), GOAL[:3])
    yaw = vehicle.pose()[3]
    squared = localization.errors[-1][1]
    return [("arrived", "%.3f m from the goal by the estimate, %.3f m and %.3f rad by the truth" % (
                by_estimate, vehicle.distance(GOAL), abs(math.remainder(yaw - GOAL[3], 2 * math.pi)))),
            ("95 % ellipse", "%s the truth: %.2f of %.2f" % (
                "holds" if squared <= ELLIPSE_95 else "does not hold", squared, ELLIPSE_95)),
            ("touched", vehicle.contact.data if vehicle.contact else "nothing (%d contacts)" % vehicle.contacts.data)]


def cells_of(map_file):
    """(columns, the bytes of all cells) of a map whose image is a PGM."""
    import yaml
    with open(map_file) as file:
        image = yaml.safe_load(file)["image"]
    with open(os.path.join(os.path.dirname(map_file), image), "rb") as file:
        content = file.read()
    head = re.match(rb"P5\s+(?:#.*\n)*(\d+)\s+(\d+)\s+\d+\s", content)
    return int(head.group(1)), content[head.end():]


def difference(map_file, shipped):
    columns, cells = cells_of(map_file)
    shipped_columns, shipped_cells = cells_of(shipped)
    if (columns, len(cells)) != (shipped_columns, len(shipped_cells)):
        return "of another size than the shipped map"
    pairs = [pair for pair in zip(cells, shipped_cells) if pair[0] != pair[1]]
    opposite = sum(1 for pair in pairs if set(pair) == {0, 254})
    return "%d of %d cells differ from the shipped map, %d free in one and occupied in the other" % (
        len(pairs), len(cells), opposite)


def survey(nodes, vehicle, localization, out):
    """Maps the site on the estimate. Returns the rows of the report."""
    map_file = os.path.join(out, "projected_map.yaml")
    rows = demo_run.survey(nodes, vehicle, Mapping(nodes), map_file, LARGEST_SURVEY_ERROR)
    metres = [error[0] for error in localization.errors]
    localization.errors.clear()
    return rows + [("its estimate", "%.3f m off on average, %.3f at most" % (sum(metres) / len(metres), max(metres))),
                   ("map", difference(map_file, share_file("maps", "dexrov_site.yaml")))]


def drive(vehicle, localization, waypoints):
    driven = vehicle.driven_m
    seconds = vehicle.drive_file("", waypoints, DRIVE_SECONDS)
    return [("driven", "%.2f m in %.1f s" % (vehicle.driven_m - driven, seconds))] + localization.rows()


def run(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    waypoints = os.path.abspath(os.path.join(arguments.out, "waypoints.yaml"))
    if os.path.exists(waypoints):
        os.remove(waypoints)
    launch_arguments = ["rviz:=" + str(arguments.rviz).lower(), "seed:=%d" % arguments.seed,
                        "survey:=" + str(arguments.survey).lower(),
                        "waypoints_file:=" + waypoints, "save_folder:=" + os.path.abspath(arguments.out),
                        "load_folder:=" + os.path.abspath(arguments.out)]
    if arguments.record:
        launch_arguments.append("record:=" + os.path.abspath(os.path.join(arguments.out, "navigation")))
    log = os.path.join(arguments.out, "localization_demo.log")
    with Nodes("localization_demo.launch", launch_arguments, log) as nodes:
        print("localization: nodes start on %s" % os.environ["ROS_MASTER_URI"], flush=True)
        vehicle = Vehicle(nodes)
        localization = Localization(nodes, vehicle)
        vehicle.wait_until_ready()
        localization.wait_until_known()
        print("localization: the vehicle knows where it is after %.1f s" % vehicle.now(), flush=True)
        rows = survey(nodes, vehicle, localization, arguments.out) if arguments.survey else []
        statistics, path = Planner(nodes, vehicle).plan(GOAL)
        rows += plan_rows(statistics, path)
        nodes.wait_until(lambda: os.path.exists(waypoints), 10.0, "waypoint file")
        print("localization: a path is found, the vehicle drives", flush=True)
        rows += drive(vehicle, localization, waypoints) + arrival_rows(vehicle, localization)
        for row in rows:
            print("  %-14s %s" % row)
        if arguments.rviz and sys.stdin.isatty():
            input("localization: press Enter to close rviz ")
        error = vehicle.distance(GOAL)
        print("localization: seed=%d length_m=%.3f arrival_error_m=%.3f ellipse=%s contacts=%d waypoints=%s" % (
            arguments.seed, statistics.length_m, error,
            "held" if localization.errors[-1][1] <= ELLIPSE_95 else "missed", vehicle.contacts.data, waypoints))
        vehicle.check_untouched()
        if error > LARGEST_ARRIVAL_ERROR:
            raise SessionFailed("the vehicle arrived %.3f m from the goal" % error)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rviz", action="store_true", help="show it in rviz")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="other errors of all sensors (default: 1)")
    parser.add_argument("--survey", action="store_true", help="map the site first, on the estimate")
    parser.add_argument("--out", default="out", metavar="FOLDER", help="for the results (default: out)")
    parser.add_argument("--record", action="store_true", help="what vehicle_localizer hears, as a bag")
    run_session("localization", run, parser.parse_args())


if __name__ == "__main__":
    main()
