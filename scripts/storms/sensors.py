"""A vehicle that knows its pose by its sensors alone drives to and fro: what vehicle_localizer takes does not grow.

IMU, DVL, pressure and acoustic fixes, planned and driven on the estimate (localization_demo.launch without the camera), at
SPEED times real time. Holds if OK is never said while the estimate is off by MOST_OFF for OFF_SECONDS, LOST is never said, nothing
is touched, resident memory grows, surely, by no more than HOURLY_GROWTH in a simulated hour, and the last third of the time takes no more than
CPU_GROWTH of the processor time of the first.
"""
import collections
import math

from ros_session import SessionFailed, set_simulator

from .session import Overrides, Session, cpu_seconds, process_id, resident_mb
from .soak import hourly_growth

NODE = "/vehicle_localizer"
ENDS = ((10.6115, -12.4845, 2.947, 2.464), (4.66, -1.92, 2.9, 1.99))  # the demo's start, and before the panel
SPEED = 8.0            # simulated seconds in one of the wall clock; faster, messages come too far before their /clock
SAMPLE_SECONDS = 30.0  # of simulated time
PRINTED = 20           # every so many samples
MOST_OFF = 1.0         # m
OFF_SECONDS = 2.0      # of simulated time
HOURLY_GROWTH = 0.01
CPU_GROWTH = 1.2


class Estimate:
    """What the localiser says beside the truth."""

    def __init__(self, vehicle):
        import rospy
        from nav_msgs.msg import Odometry
        from std_msgs.msg import String
        self.vehicle, self.status, self.largest = vehicle, "", 0.0
        self.right, self.wrong = None, 0.0  # simulated s: when OK was last no lie, and the longest time since
        self.said = collections.Counter()  # in samples
        rospy.Subscriber("/odometry/filtered", Odometry, self.hear)
        rospy.Subscriber("/localization_status", String, lambda message: setattr(self, "status", message.data))

    def hear(self, message):
        """Against the truth with the same stamp, or none where that came at another time."""
        truth = self.vehicle.truth
        if truth is not None and truth.header.stamp == message.header.stamp:
            a, b = truth.pose.pose.position, message.pose.pose.position
            self.judge(math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)), message.header.stamp.to_sec())

    def judge(self, off, now):
        self.largest = max(self.largest, off)
        if self.right is None or off < MOST_OFF or not self.status.startswith("OK"):
            self.right = now
        self.wrong = max(self.wrong, now - self.right)

    def check(self):
        if self.status.startswith("LOST") or self.wrong > OFF_SECONDS:
            raise SessionFailed("%s; off for %.1f s, %.2f m at most" % (self.status, self.wrong, self.largest))


def watch(vehicle, drive, estimate, seconds):
    """(simulated s, MB, s of the processor) every SAMPLE_SECONDS."""
    pid, begin, samples = process_id(NODE), vehicle.now(), []
    while not samples or samples[-1][0] < seconds:
        drive.seconds(0.2)
        estimate.check()
        if process_id(NODE) != pid:
            raise SessionFailed("vehicle_localizer has ended")
        if vehicle.now() < begin + SAMPLE_SECONDS * (len(samples) + 1):
            continue
        samples.append((vehicle.now() - begin, resident_mb(pid), cpu_seconds(pid)))
        estimate.said[estimate.status.split(":")[0]] += 1
        if len(samples) % PRINTED == 0:
            print("storm: %.2f h simulated, %.1f MB, %.0f s of CPU, at most %.2f m off, %s" % (
                samples[-1][0] / 3600.0, samples[-1][1], samples[-1][2], estimate.largest, estimate.status), flush=True)
    return samples


def cpu_shares(samples):
    """Of the first and of the last third: seconds of the processor in a simulated second."""
    third = len(samples) // 3
    return [(b[2] - a[2]) / (b[0] - a[0]) for a, b in ((samples[0], samples[third]), (samples[-1 - third], samples[-1]))]


def verdict(samples, estimate):
    if len(samples) < 12:
        raise SessionFailed("too short: %d samples" % len(samples))
    kept = samples[len(samples) // 3:]
    growth, half = hourly_growth([(seconds / 3600.0, megabytes) for seconds, megabytes, _ in kept])
    first, last = cpu_shares(samples)
    text = "%.1f simulated h: %.1f MB, %+.2f ± %.2f %% an hour; %.1f ms of CPU in a second at first, %.1f at last; at most %.2f m off; %s" % (
        samples[-1][0] / 3600.0, samples[-1][1], 100 * growth, 100 * half, 1e3 * first, 1e3 * last, estimate.largest,
        ", ".join("%s in %d samples" % each for each in estimate.said.most_common()))
    if growth - half > HOURLY_GROWTH or last > CPU_GROWTH * first:
        raise SessionFailed(text)
    return text


def storm(hours, folder, given):
    simulator = Overrides(folder, given).write("simulator", "localization_simulator.yaml", image_camera_enabled=False)
    with Session(folder, "localization_demo.launch", ["simulator_overrides:=" + simulator], ENDS) as session:
        estimate = Estimate(session.vehicle)
        session.drive.goes_on()
        set_simulator("real_time_factor", SPEED)
        return verdict(watch(session.vehicle, session.drive, estimate, 3600.0 * hours), estimate)
