"""projected_map as its receivers have it, in metres: what has been occupied, and what a path runs through."""
import math
import re
import struct
import threading
import time

OCCUPIED = re.compile(b"[\x41-\x64]+")  # cells of 65 per cent and more
BEFORE_SECONDS = 5.0  # of the wall clock: what was occupied all the time from so long before a kill is not erased


def occupied_squares(content):
    """The resolution of a serialized map and its occupied cells as (i, j): the squares i·resolution to
    (i + 1)·resolution of the frame. The extent of a map may change; the squares stay where they are, since its origin
    moves by whole cells. From the bytes: a message of rospy takes ten times as long to make."""
    frame_end = 16 + struct.unpack_from("<I", content, 12)[0]
    resolution, width, _, x, y = struct.unpack_from("<fIIdd", content, frame_end + 8)
    column, row = round(x / resolution), round(y / resolution)
    data = content[frame_end + 80:]  # after 3 numbers, 7 of the origin, and the length
    return resolution, frozenset((column + i % width, row + i // width) for run in OCCUPIED.finditer(data)
                                 for i in range(run.start(), run.end()))


def points_of(path, spacing=0.02):
    """Points of the path's polyline, every `spacing` metres."""
    corners = [(pose.pose.position.x, pose.pose.position.y) for pose in path.poses]
    for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
        steps = max(1, math.ceil(math.dist((x0, y0), (x1, y1)) / spacing))
        for i in range(steps + 1):
            yield x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps


class SeenMap:
    def __init__(self):
        import rospy
        self.lock = threading.Lock()
        self.resolution = None
        self.occupied = frozenset()
        self.history = []     # (time, occupied), the newest last
        self.whole_maps = 0
        self.expected = None  # squares that the next map has to have
        self.erased = 0       # of all that was expected
        self.most_erased = 0  # in one kill
        self.most_freed = 0   # from one map to the next without a kill, of what had been occupied as long
        self.steady = frozenset()
        rospy.Subscriber("projected_map", rospy.AnyMsg, self.on_map, queue_size=1, buff_size=1 << 24)

    def on_map(self, message):
        resolution, squares = occupied_squares(message._buff)
        now = time.monotonic()
        with self.lock:
            self.resolution = resolution
            self.occupied = squares
            self.whole_maps += 1
            self.history.append((now, squares))
            while len(self.history) > 1 and self.history[1][0] < now - 2 * BEFORE_SECONDS:
                self.history.pop(0)
            if self.expected is not None:
                self.erased += len(self.expected - squares)
                self.most_erased = max(self.most_erased, len(self.expected - squares))
                self.expected = None
            else:
                self.most_freed = max(self.most_freed, len(self.steady - squares))
            self.steady = self.common_since(now - BEFORE_SECONDS)

    def common_since(self, begin):
        """Occupied in every map since then; nothing, where the first is younger."""
        first = max([i for i, (at, _) in enumerate(self.history) if at <= begin], default=None)
        if first is None:
            return frozenset()
        return frozenset.intersection(*(squares for _, squares in self.history[first:]))

    def occupied_before(self):
        """The squares that were occupied in every map since BEFORE_SECONDS ago."""
        with self.lock:
            return self.common_since(time.monotonic() - BEFORE_SECONDS)

    def expect(self, squares):
        """They are to be occupied in the first map that comes from now on."""
        with self.lock:
            self.expected = squares | (self.expected or frozenset())

    def crossed(self, path, squares):
        """How many points of the path lie in one of `squares`."""
        return sum((math.floor(x / self.resolution), math.floor(y / self.resolution)) in squares
                   for x, y in points_of(path))
