"""A robot of somebody else: two wheels, an outline that is not round, base_link above the floor, and no ear for linear.y.

It obeys cmd_vel 0.1 s later, publishes tf as such robots do, and knows how deep its outline is in the walls of a map.
"""
import math
import os
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "security"))
import rospy
from geometry_msgs.msg import TransformStamped, Twist

from message_classes import message_class

PERIOD = 0.02  # s
LATENCY = 0.1  # s
ACCELERATION, TURN_ACCELERATION = 1.5, 4.0  # m/s^2, rad/s^2
CEASED = 0.5  # s without a command, after which it stands


def towards(value, target, most):
    return value + max(-most, min(most, target - value))


class WheeledRobot:
    def __init__(self, x, y, yaw, outline, base_height, is_wall):
        self.x, self.y, self.yaw, self.outline, self.base_height, self.is_wall = x, y, yaw, outline, base_height, is_wall
        self.speed = self.rate = 0.0
        self.commands, self.jump = [], (0.0, 0.0)
        self.sideways = self.fastest = self.driven = 0.0
        self.contacts = []
        self.ends = threading.Event()
        self.broadcast = rospy.Publisher("/tf", message_class("tf2_msgs/TFMessage"), queue_size=10)
        rospy.Subscriber("cmd_vel", Twist, self.obey, queue_size=10, tcp_nodelay=True)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def end(self):
        self.ends.set()
        self.thread.join()

    def obey(self, message):
        self.commands.append((time.monotonic() + LATENCY, message))
        self.sideways = max(self.sideways, abs(message.linear.y), abs(message.linear.z))
        self.fastest = max(self.fastest, abs(message.linear.x))

    def run(self):
        followed, since, due = Twist(), 0.0, time.monotonic()
        while not self.ends.is_set():
            due += PERIOD
            time.sleep(max(0.0, due - time.monotonic()))
            while self.commands and self.commands[0][0] <= due:
                since, followed = self.commands.pop(0)
            if due - since > CEASED:
                followed = Twist()
            self.move(followed)
            self.tell()

    def move(self, command):
        self.speed = towards(self.speed, command.linear.x, ACCELERATION * PERIOD)
        self.rate = towards(self.rate, command.angular.z, TURN_ACCELERATION * PERIOD)
        middle = self.yaw + 0.5 * self.rate * PERIOD
        self.x += self.speed * PERIOD * math.cos(middle)
        self.y += self.speed * PERIOD * math.sin(middle)
        self.yaw += self.rate * PERIOD
        self.driven += abs(self.speed) * PERIOD + abs(self.rate) * PERIOD
        if any(self.is_wall(x, y) for x, y in self.edge()):
            self.contacts.append((round(self.x, 3), round(self.y, 3), round(self.yaw, 3)))

    def edge(self):
        """Points of the outline, at most 2 cm apart."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        for (ax, ay), (bx, by) in zip(self.outline, self.outline[1:] + self.outline[:1]):
            pieces = max(1, int(math.hypot(bx - ax, by - ay) / 0.02))
            for i in range(pieces):
                x, y = ax + (bx - ax) * i / pieces, ay + (by - ay) * i / pieces
                yield self.x + c * x - s * y, self.y + s * x + c * y

    def tell(self):
        """map -> odom as its localiser has it, odom -> base_link as its wheels do."""
        now = rospy.Time.now()
        transforms = []
        for parent, child, x, y, z, yaw in (("map", "odom", self.jump[0], self.jump[1], 0.0, 0.0),
                                            ("odom", "base_link", self.x, self.y, self.base_height, self.yaw)):
            transform = TransformStamped()
            transform.header.stamp, transform.header.frame_id, transform.child_frame_id = now, parent, child
            position, rotation = transform.transform.translation, transform.transform.rotation
            position.x, position.y, position.z = x, y, z
            rotation.z, rotation.w = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
            transforms.append(transform)
        self.broadcast.publish(message_class("tf2_msgs/TFMessage")(transforms))
