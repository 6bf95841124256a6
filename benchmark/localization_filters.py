"""The filters that localization_peers compares, and the parameters with which each is given the same inputs."""
import math
import os
import subprocess
from collections import namedtuple

from node_latency_ros import Usage, end, start

# Chi squared at 0.999 for 1, 2, 3 and 6 numbers: the gate of vehicle_localizer, as robot_localization has it.
GATES = {1: math.sqrt(10.83), 2: math.sqrt(13.82), 3: math.sqrt(16.27), 6: math.sqrt(22.46)}
POSITION, ATTITUDE, VELOCITY, TURN, ACCELERATION = range(5)  # places of three in robot_localization's 15 numbers
YAW = 5

# `stamp`: of the first measurement of the IMU. `pose`: x, y, z by the first acoustic fix, roll, pitch, yaw by the first
# orientation of the IMU.
StartState = namedtuple("StartState", "stamp pose")


class Filter:
    """A node below its own name. What it estimates comes on `topic`."""
    title, package, program, topic = "", "", "", "odometry/filtered"
    remaps = ()
    planar = False  # estimates x, y and yaw only

    def __init__(self, name):
        self.name, self.process, self.usage = name, None, None

    def parameters(self, inputs, start_state):
        """`inputs`: the topics that there are."""
        return {}

    def arguments(self):
        return ["%s:=%s" % remap for remap in self.remaps] + ["%s:=%s" % (self.topic, self.output()), "__name:=" + self.name]

    def output(self):
        return "/%s/estimate" % self.name

    def is_there(self):
        return bool(executable(self.package, self.program))

    def begin(self, inputs, start_state, logs):
        import rospy
        for key, value in self.parameters(inputs, start_state).items():
            rospy.set_param("/%s/%s" % (self.name, key), value)
        self.process = start([executable(self.package, self.program)] + self.arguments(), os.path.join(logs, self.name + ".log"))
        self.usage = Usage(self.process.pid)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process:
            end(self.process)


def executable(package, program):
    """Empty without it."""
    found = subprocess.run(["catkin_find", "--first-only", "--libexec", package, program], stdout=subprocess.PIPE,
                           stderr=subprocess.DEVNULL, universal_newlines=True, check=False)
    return found.stdout.strip()


class VehicleLocalizer(Filter):
    title, package, program = "vehicle_localizer", "grid_path_planner", "vehicle_localizer"


def uses(*groups):
    """robot_localization's list of 15: which numbers of a measurement are used."""
    return [index // 3 in groups for index in range(15)]


class RobotLocalization(Filter):
    """In the map's frame, without tf of its own; late fixes are put in their place. Its own initial covariance of 1e-9 would
    make its gates reject every fix: the start is known to 1 m and 0.1 rad."""
    package = "robot_localization"
    takes_yaw = True  # all of them; else the first only, and the rates of turn

    def parameters(self, inputs, start_state):
        values = {"frequency": 50, "sensor_timeout": 0.1, "world_frame": "map", "publish_tf": False, "two_d_mode": False,
                  "smooth_lagged_data": True, "history_length": 5.0, "gravitational_acceleration": 9.80665,
                  "initial_state": list(start_state.pose) + [0.0] * 9,
                  "initial_estimate_covariance": diagonal([1.0] * 3 + [0.01] * 3 + [1.0] * 9)}
        imu = uses(ATTITUDE, TURN, ACCELERATION)
        imu[YAW] = self.takes_yaw
        values.update(sensor("imu0", "imu/data", imu, {}))
        values.update({"imu0_remove_gravitational_acceleration": True})
        values.update(sensor("twist0", "dvl/twist", uses(VELOCITY), {"twist": 3}))
        values.update(sensor("pose0", "depth", [index == 2 for index in range(15)], {"": 1}))
        values.update(sensor("pose1", "usbl/pose", uses(POSITION), {"": 3}))
        if "marker_pose" in inputs:
            values.update(sensor("pose2", "marker_pose", uses(POSITION, ATTITUDE), {"": 6}))
        return values


def sensor(name, topic, used, gates):
    """`gates`: how many numbers of the part of a measurement are compared together."""
    values = {name: "/" + topic, name + "_config": used, name + "_queue_size": 100}
    for part, numbers in gates.items():
        values["_".join(filter(None, (name, part, "rejection_threshold")))] = GATES[numbers]
    return values


def diagonal(variances):
    size = len(variances)
    return [variances[row] if row == column else 0.0 for row in range(size) for column in range(size)]


class ExtendedKalmanFilter(RobotLocalization):
    title, program = "robot_localization, EKF, yaw of the IMU", "ekf_localization_node"


class UnscentedKalmanFilter(RobotLocalization):
    title, program = "robot_localization, UKF, yaw of the IMU", "ukf_localization_node"


class ExtendedKalmanFilterOfRates(ExtendedKalmanFilter):
    title, takes_yaw = "robot_localization, EKF, rates of turn", False


class UnscentedKalmanFilterOfRates(UnscentedKalmanFilter):
    title, takes_yaw = "robot_localization, UKF, rates of turn", False


class Fuse(Filter):
    """fuse's fixed-lag smoother around its planar unicycle: x, y, yaw, their rates, the accelerations along x and y. It has no
    gates but losses: Cauchy's, as wide as the gates, was the best of those that were tried. A longer lag gained nothing."""
    title, package, program = "fuse, yaw of the IMU", "fuse_optimizers", "fixed_lag_smoother_node"
    planar, takes_yaw = True, True

    def parameters(self, inputs, start_state):
        sensors = {"imu": self.imu(), "dvl": TWIST, "usbl": FIX, "start": START}
        if "marker_pose" in inputs:
            sensors["markers"] = MARKERS
        values = {"optimization_frequency": 20, "lag_duration": 2.0, "unicycle": {"process_noise_diagonal": UNICYCLE_NOISE},
                  "motion_models": {"unicycle": {"type": "fuse_models::Unicycle2D"}},
                  "sensor_models": {name: model(kind, name == "start") for name, (kind, _) in sensors.items()},
                  "publishers": {"odometry": {"type": "fuse_models::Odometry2DPublisher"}},
                  "odometry": {"publish_tf": False, "publish_frequency": 50, "world_frame_id": "map"}}
        values.update({name: dict(own, queue_size=100) for name, (_, own) in sensors.items()})
        return values

    def imu(self):
        """Its yaw is one about the map's axis already: no frame to bring it to."""
        return "Imu2D", {"topic": "/imu/data", "orientation_dimensions": ["yaw"] if self.takes_yaw else [],
                         "angular_velocity_dimensions": ["yaw"], "twist_target_frame": "base_link",
                         "linear_acceleration_dimensions": ["x", "y"], "acceleration_target_frame": "base_link",
                         "remove_gravitational_acceleration": True, "gravitational_acceleration": 9.80665}

    def begin(self, inputs, start_state, logs):
        super().begin(inputs, start_state, logs)
        send_start("/%s/set_pose" % self.name, start_state)


def loss(numbers):
    """Of a measurement of so many numbers."""
    return {"type": "fuse_loss::CauchyLoss", "a": GATES[numbers]}


# robot_localization's variances a second of x, y, yaw, their rates and the accelerations; fuse has no default.
UNICYCLE_NOISE = [0.05, 0.05, 0.06, 0.025, 0.025, 0.02, 0.01, 0.01]
TWIST = ("Twist2D", {"topic": "/dvl/twist", "linear_dimensions": ["x", "y"], "target_frame": "base_link", "linear_loss": loss(2)})
FIX = ("Pose2D", {"topic": "/usbl/pose", "position_dimensions": ["x", "y"], "loss": loss(2)})
MARKERS = ("Pose2D", {"topic": "/marker_pose", "position_dimensions": ["x", "y"], "orientation_dimensions": ["yaw"], "loss": loss(3)})
# Waits for a pose with a stamp: when the node starts there is no time yet. Deviations as the list above; the pose has its own.
START = ("Unicycle2DIgnition", {"publish_on_startup": False, "reset_service": "", "initial_sigma": [1.0] * 8})


def model(kind, starts):
    return {"type": "fuse_models::" + kind, "motion_models": ["unicycle"], "ignition": starts}


def send_start(topic, start_state):
    """The message waits for the subscriber."""
    import rospy
    from geometry_msgs.msg import PoseWithCovarianceStamped
    message = PoseWithCovarianceStamped()
    message.header.stamp = start_state.stamp
    message.pose.covariance = diagonal([1.0] * 3 + [0.01] * 3)
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    position.x, position.y = start_state.pose[:2]
    orientation.z, orientation.w = math.sin(start_state.pose[5] / 2), math.cos(start_state.pose[5] / 2)
    rospy.Publisher(topic, PoseWithCovarianceStamped, queue_size=1, latch=True).publish(message)


class FuseOfRates(Fuse):
    title, takes_yaw = "fuse, rates of turn", False


def filters_in_environment():
    all_filters = [VehicleLocalizer("ours"), ExtendedKalmanFilter("ekf"), ExtendedKalmanFilterOfRates("ekf_rates"),
                   UnscentedKalmanFilter("ukf"), UnscentedKalmanFilterOfRates("ukf_rates"), Fuse("fuse"), FuseOfRates("fuse_rates")]
    return [each for each in all_filters if each.is_there()]
