#!/usr/bin/env python3
"""A flight without a map on a roscore of its own: a tour through a grove and a maze, goal by goal.

    rosrun grid_path_planner flight_demo_run.py [--rviz] [--speed FACTOR] [--out FOLDER] [--log] [--goals N]

path_planner plans on what projected_map has mapped so far, through what was not seen where that is shorter;
local_planner follows that path, and only where it has seen that nothing is. Into FOLDER (default: out) go the nodes'
output, flight_demo.log, and with --log what the pilot was given and answered, flight_demo.flight. Exit code 0 only if
nothing was touched and every goal was reached.
"""
import argparse
import os
import sys
import time

from ros_session import START_SECONDS, Nodes, SessionFailed, Vehicle, run_session

# x, y in m; the tour ends where it began.
TOUR = ((30.0, 10.0), (40.0, 7.0), (47.0, 4.5), (38.7, -7.5), (0.0, 0.0))
HEIGHT = 1.5                # m
LARGEST_OFFSET = 1.5        # m, of a goal that counts as reached
LEG_SECONDS = 300.0         # simulated


class Tour:
    """Sends goals to path_planner and hears what local_planner does."""

    def __init__(self, nodes, vehicle):
        import rospy
        from geometry_msgs.msg import PoseStamped
        from grid_path_planner.msg import AvoidanceStatus
        self.nodes, self.vehicle, self.PoseStamped = nodes, vehicle, PoseStamped
        self.said = []
        self.goal = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        rospy.Subscriber("avoidance_status", AvoidanceStatus, self.said.append)

    def send(self, place):
        goal = self.PoseStamped()
        goal.header.frame_id, goal.header.stamp = "map", self.vehicle.stamp
        goal.pose.position.x, goal.pose.position.y, goal.pose.position.z = place + (HEIGHT,)
        goal.pose.orientation.w = 1.0
        self.goal.publish(goal)

    def arrived(self, place):
        return self.vehicle.distance(place + (HEIGHT,)) < LARGEST_OFFSET and self.said[-1].status == "ARRIVED"

    def fly_to(self, place):
        """Asks again every ten simulated seconds in which nothing is flown: maps grow meanwhile."""
        self.nodes.wait_until(lambda: self.goal.get_num_connections() > 0 and self.said, START_SECONDS, "path_planner")
        begin = asked = self.vehicle.now()
        self.send(place)
        while not self.arrived(place):
            self.nodes.check()
            self.vehicle.check_untouched()
            now = self.vehicle.now()
            if now - begin > LEG_SECONDS:
                raise SessionFailed("x %g, y %g was not reached: %s: %s" % (
                    place + (self.said[-1].status, self.said[-1].sentence)))
            if self.said[-1].status not in ("FLYING", "BLOCKED") and now - asked > 10.0:
                self.send(place)
                asked = now
            time.sleep(0.02)
        return self.vehicle.now() - begin


def run(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    launch_arguments = ["rviz:=" + str(arguments.rviz).lower(), "real_time_factor:=%g" % arguments.speed,
                        "save_folder:=" + os.path.abspath(arguments.out)]
    if arguments.log:
        launch_arguments.append("log:=" + os.path.abspath(os.path.join(arguments.out, "flight_demo.flight")))
    with Nodes("flight_demo.launch", launch_arguments, os.path.join(arguments.out, "flight_demo.log")) as nodes:
        print("flight: nodes start on %s" % os.environ["ROS_MASTER_URI"], flush=True)
        vehicle = Vehicle(nodes)
        tour = Tour(nodes, vehicle)
        vehicle.wait_until_ready()
        begin = vehicle.now()
        for place in TOUR[:arguments.goals]:
            seconds = tour.fly_to(place)
            print("flight: x %5.1f  y %5.1f  after %.1f s" % (place + (seconds,)), flush=True)
        if arguments.rviz and sys.stdin.isatty():
            input("flight: press Enter to close rviz ")
        print("flight: goals=%d length_m=%.1f seconds=%.1f contacts=%d" % (
            arguments.goals, vehicle.driven_m, vehicle.now() - begin, vehicle.contacts.data))
        vehicle.check_untouched()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rviz", action="store_true", help="show it in rviz")
    parser.add_argument("--speed", type=float, default=1.0, metavar="FACTOR",
                        help="simulated seconds in a second of the wall clock, if the machine allows (default: 1)")
    parser.add_argument("--out", default="out", metavar="FOLDER", help="for the results (default: out)")
    parser.add_argument("--log", action="store_true", help="keep what the pilot was given: some 9 MB a second")
    parser.add_argument("--goals", type=int, default=len(TOUR), choices=range(1, len(TOUR) + 1), metavar="N",
                        help="fly to the first N goals only (default: %d)" % len(TOUR))
    run_session("flight", run, parser.parse_args())


if __name__ == "__main__":
    main()
