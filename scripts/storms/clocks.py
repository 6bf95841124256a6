"""Simulated time jumps back and forth: the simulator is killed, and starts again with another time and the vehicle
where it was. Holds if no other node ends, the vehicle goes on after every jump and touches nothing."""
import os
import signal

from ros_session import SessionFailed

from .session import BEGIN, BACK_SECONDS, Demo, patience, process_id

JUMPS = (0.1, -2.0, 3600.0, -3600.0, 2e9, -1.9e9, -100.0)  # s


def jump(demo, seconds):
    import rospy
    pid = process_id("/simulator")
    os.kill(pid, signal.SIGKILL)
    for name, value in zip(BEGIN, demo.vehicle.pose()):
        rospy.set_param("/simulator/" + name, value)
    to = min(max(1.0, demo.vehicle.now() + seconds), 2e9)
    rospy.set_param("/simulator/start_time", to)
    demo.vehicle.clock = None
    demo.nodes.wait_until(lambda: process_id("/simulator") not in (None, pid) and demo.vehicle.clock,
                          patience(BACK_SECONDS), "simulator")
    demo.drive.goes_on()


def storm(rounds, folder, given):
    rounds = int(rounds)
    with Demo(folder, given) as demo:
        demo.drive.goes_on()
        before = demo.pids()
        for number in range(rounds * len(JUMPS)):
            jump(demo, JUMPS[number % len(JUMPS)])
        ended = [node for node, pid in demo.pids().items() if pid != before[node] and node != "/simulator"]
        if ended:
            raise SessionFailed("these have ended: " + ", ".join(ended))
    return "%d jumps, the vehicle went on after each and touched nothing" % (rounds * len(JUMPS))
