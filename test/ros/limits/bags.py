"""Recordings that `grid_path` reads."""
import genpy
import rosbag
from right_messages import of

SECONDS = 6
LEVEL = {"w": 1.0}
COVARIANCE = [1e-4 if i % 7 == 0 else 0.0 for i in range(36)]


def write_plans(file, messages):
    """`messages`: pairs of a topic and what came there."""
    with rosbag.Bag(file, "w") as bag:
        for i, (topic, message) in enumerate(messages):
            bag.write(topic, message, genpy.Time(1 + i))


def write_dive(file):
    """A vehicle that rests, and what its sensors and a panel with markers say of that."""
    with rosbag.Bag(file, "w") as bag:
        for tick in range(50 * SECONDS):
            now = genpy.Time.from_sec(1000.0 + 0.02 * tick)
            for topic, message in heard(tick, now).items():
                bag.write(topic, message, now)


def header(frame, now):
    return {"frame_id": frame, "stamp": {"secs": now.secs, "nsecs": now.nsecs}}


def heard(tick, now):
    """{topic: message}"""
    messages = {
        "imu/data": of("sensor_msgs/Imu", header=header("imu_link", now), orientation=LEVEL,
                       linear_acceleration={"z": 9.80665}),
        "dvl/twist": of("geometry_msgs/TwistWithCovarianceStamped", header=header("dvl_link", now),
                        twist={"covariance": COVARIANCE})}
    if tick % 10 == 0:
        messages["/tf"] = of("tf2_msgs/TFMessage", transforms=[
            {"header": header("base_link", now), "child_frame_id": name, "transform": {"rotation": LEVEL}}
            for name in ("imu_link", "dvl_link")])
        messages["marker_pose"] = of("geometry_msgs/PoseWithCovarianceStamped", header=header("map", now),
                                     pose={"pose": {"orientation": LEVEL}, "covariance": COVARIANCE})
    return messages
