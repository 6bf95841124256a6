"""Estimates of a pose over time, their errors against the truth and how long they took, for localization_peers. Needs
python3-scipy."""
import struct
import time

import numpy
from scipy.spatial.transform import Rotation, Slerp

PLANE = [0, 1, 5]  # x, y and yaw among the six numbers of a pose

def angles_of(orientation):
    """Roll, pitch, yaw in rad."""
    return tuple(Rotation.from_quat((orientation.x, orientation.y, orientation.z, orientation.w)).as_euler("xyz").tolist())


def stamp_of(data):
    """Nanoseconds, of a message that begins with a header and is left as bytes."""
    seconds, nanoseconds = struct.unpack_from("<II", data, 4)
    return 1000000000 * seconds + nanoseconds


class Arrivals:
    """When messages came, by the steady clock, by what they are stamped with; handed over as bytes, so that other
    messages do not wait for this process."""

    def __init__(self):
        self.times = {}  # nanoseconds: s

    def take(self, message):
        self.times.setdefault(stamp_of(message._buff), time.monotonic())


class Track:
    """Poses by the time that they are stamped with, from nav_msgs/Odometry."""

    def __init__(self):
        self.arrivals = Arrivals()
        self.waiting = []  # messages as bytes
        self.poses = {}    # nanoseconds: (position, quaternion x y z w, covariance 6x6 of position and fixed axes)

    def hear(self, message):
        self.arrivals.take(message)
        self.waiting.append(message._buff)

    def unpack(self):
        from nav_msgs.msg import Odometry
        for data in self.waiting:
            self.take(Odometry().deserialize(data))
        self.waiting = []

    def take(self, message):
        pose = message.pose.pose
        self.poses[message.header.stamp.to_nsec()] = (
            (pose.position.x, pose.position.y, pose.position.z),
            (pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w),
            message.pose.covariance)

    def begin(self):
        return min(self.poses) if self.poses else None

    def between(self, begin, end):
        """(stamps, positions, rotations, covariances)"""
        stamps = sorted(stamp for stamp in self.poses if begin <= stamp <= end)
        columns = [numpy.array([self.poses[stamp][column] for stamp in stamps]) for column in range(3)]
        return numpy.array(stamps), columns[0], Rotation.from_quat(columns[1]), columns[2].reshape(-1, 6, 6)


class Truth(Track):
    def at(self, stamps):
        """(positions, rotations), interpolated. Precondition: the stamps lie between its first and its last."""
        own, positions, rotations, _ = self.between(min(self.poses), max(self.poses))
        columns = [numpy.interp(stamps, own, positions[:, column]) for column in range(3)]
        return numpy.stack(columns, axis=1), Slerp(own, rotations)(stamps)


def errors(track, truth, begin):
    """(errors, covariances) of the estimates from `begin` on: x, y, z in m, turns about the fixed axes in rad. None without
    an estimate."""
    begin, end = max(begin, min(truth.poses)), max(truth.poses)
    if not any(begin <= stamp <= end for stamp in track.poses):
        return None
    stamps, positions, rotations, covariances = track.between(begin, end)
    true_positions, true_rotations = truth.at(stamps)
    turns = (true_rotations * rotations.inv()).as_rotvec()
    return numpy.concatenate((true_positions - positions, turns), axis=1), covariances


def nees(found, covariances):
    """Of each estimate; its mean is the number of errors where the covariance is right."""
    return numpy.einsum("ij,ij->i", found, numpy.linalg.solve(covariances, found[:, :, None])[:, :, 0])


def delays(track, inputs, begin):
    """Milliseconds from the arrival of the measurement of the IMU to that of the estimate with its stamp, from `begin` on."""
    both = [(own, inputs.times[stamp]) for stamp, own in track.arrivals.times.items() if stamp >= begin and stamp in inputs.times]
    return 1e3 * numpy.array([own - given for own, given in both])


def delay_cell(track, inputs, begin):
    """Median, 99th percentile and largest; a dash where no estimate has the stamp of a measurement."""
    found = delays(track, inputs, begin)
    return "%.1f, %.1f, %.1f" % tuple(numpy.percentile(found, (50, 99, 100))) if len(found) else "–"


def cells(track, truth, begin, planar):
    """Of localization_peers' table; dashes without an estimate, and for what a planar filter does not estimate."""
    found = errors(track, truth, begin)
    if found is None:
        return ["–"] * 6
    return ["%d" % len(found[0])] + (["–"] * 4 if planar else spatial_cells(*found)) + [plane_cell(*found)]


def spatial_cells(found, covariances):
    metres, degrees = numpy.linalg.norm(found[:, :3], axis=1), numpy.degrees(numpy.linalg.norm(found[:, 3:], axis=1))
    ratios = nees(found, covariances)
    return ["%.3f, %.3f" % (rms(metres), metres.max()), "%.2f, %.2f" % (rms(degrees), degrees.max()),
            "%.1f, %.1f" % (numpy.mean(ratios), numpy.median(ratios)), "%.3f" % metres[-1]]


def plane_cell(found, covariances):
    found, covariances = found[:, PLANE], covariances[:, PLANE][:, :, PLANE]
    metres, degrees = numpy.linalg.norm(found[:, :2], axis=1), numpy.degrees(found[:, 2])
    return "%.3f, %.2f, %.1f, %.3f" % (rms(metres), rms(degrees), numpy.mean(nees(found, covariances)), metres[-1])


def rms(values):
    return numpy.sqrt(numpy.mean(values ** 2))
