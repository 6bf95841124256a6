"""The files of traits/map_files.yaml and traits/waypoint_files.yaml, made of the room."""
import math
import os
import struct
import zlib

import rooms
from genpy.message import strify_message
from genpy import Time
from right_messages import of

FREE, OCCUPIED = 254, 0
YAML = {"image": "room.pgm", "resolution": "0.5", "origin": "[-1.0, -1.0, 0.0]", "negate": "0", "occupied_thresh": "0.65",
        "free_thresh": "0.196"}


def picture(free=FREE, occupied=OCCUPIED):
    """Rows from the top."""
    values = rooms.cells(occupied, free)
    return [values[row * rooms.WIDTH:(row + 1) * rooms.WIDTH] for row in reversed(range(rooms.HEIGHT))]


def pgm(rows, header="P5\n%d %d\n255\n"):
    return (header % (rooms.WIDTH, rooms.HEIGHT)).encode() + b"".join(bytes(row) for row in rows)


def png(rows, kind, channels, palette=b""):
    """`channels(value)` are a pixel's bytes."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    lines = b"".join(b"\0" + b"".join(bytes(channels(value)) for value in row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", rooms.WIDTH, rooms.HEIGHT, 8, kind, 0, 0, 0))
            + (chunk(b"PLTE", palette) if palette else b"") + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def yaml_of(fields, end="\n"):
    return "".join("%s: %s%s" % (key, value, end) for key, value in dict(YAML, **fields).items()).encode()


def text_of_dump(data=True):
    text = strify_message(rooms.room(Time(100, 0)))
    return text if data else text[:text.index("data:")] + 'data: "<array type: int8, length: 240>"'


# name: (image, changes of the YAML); the YAML's own bytes
IMAGES = {
    "with_comment": (pgm(picture(), "P5\n# Cartographer map; 0.5 m/pixel\n%d %d\n255\n"), {}),
    "crlf_header": (pgm(picture(), "P5\r\n%d %d\r\n255\r\n"), {}),
    "plain_pgm": (("P2\n# by hand\n%d %d\n255\n" % (rooms.WIDTH, rooms.HEIGHT)).encode()
                  + "\n".join(" ".join(map(str, row)) for row in picture()).encode(), {}),
    "sixteen_bits": (b"P5\n%d %d\n65535\n" % (rooms.WIDTH, rooms.HEIGHT)
                     + b"".join(struct.pack(">H", 257 * value) for row in picture() for value in row), {}),
    "palette_png": (png(picture(), 3, lambda value: (1 if value else 7,), b"\xff\xff\xff" + b"\xfe\xfe\xfe" + bytes(18)),
                    {"image": "room.png"}),
    "alpha_png": (png(picture(), 4, lambda value: (value, 255)), {"image": "room.png"}),
    "rgb_png": (png(picture(), 2, lambda value: (value, value, max(0, value - 3))), {"image": "room.png"}),
    "negated": (pgm(picture(0, 255)), {"negate": "1"}),
    "negated_in_words": (pgm(picture(0, 255)), {"negate": "true"}),
    "mode_raw": (pgm(picture(0, 100)), {"mode": "raw"}),
    "mode_raw_of_a_picture": (pgm(picture()), {"mode": "raw"})}
UNKNOWN = [(10, 20), (40, 20)]  # of 60 x 60 cells of 0.05 m
SPOTS = bytes(205 if (i % 60, 59 - i // 60) in UNKNOWN else 254 for i in range(3600))
IMAGES["two_unknown"] = (b"P5\n60 60\n255\n" + SPOTS, {"resolution": "0.05", "origin": "[0.0, 0.0, 0.0]"})
YAMLS = {"crlf_yaml": yaml_of({}, "\r\n"), "bom_yaml": b"\xef\xbb\xbf" + yaml_of({})}
DUMPS = {"echo_without_arrays": lambda: text_of_dump(False) + "\n---\n",
         "echo_of_several": lambda: text_of_dump() + "\n---\n" + text_of_dump() + "\n---\n"}


def bag(name, topics, compression="none"):
    import rosbag
    with rosbag.Bag(name, "w", compression=compression) as bag_file:
        for topic in topics:
            bag_file.write(topic, rooms.room(Time(100, 0)), Time(100, 0))


BAGS = {"bag_on_map": (["/map"], "none"), "bag_lz4": (["/projected_map"], "lz4"),
        "bag_of_several": (["/move_base/global_costmap/costmap", "/move_base/local_costmap/costmap"], "none")}


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())
    return name


def map_file(row, folder):
    """Writes it; its name."""
    make = row.get("make", "")
    if make in BAGS:
        name = os.path.join(folder, "room.bag")
        bag(name, *BAGS[make])
        return name
    if make in DUMPS:
        return write(os.path.join(folder, "dump.yaml"), DUMPS[make]())
    image, changes = IMAGES.get(make, (pgm(picture()), {}))
    changes = dict(changes, **row.get("set", {}))
    if not changes.get("image", "").startswith("/"):
        write(os.path.join(folder, changes.get("image", YAML["image"])), image)
    return write(os.path.join(folder, "room.yaml"), YAMLS.get(make) or yaml_of(changes))


def posed(x, y, yaw):
    return {"position": {"x": x, "y": y}, "orientation": {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}}


PLACES = [(1.0, 2.0, 0.0), (3.0, 2.0, math.pi / 2)]
ROWS = [(x, y, 0.0, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)) for x, y, yaw in PLACES]


def lines(rows, separator=",", end="\n"):
    return "".join(separator.join(map(repr, row)) + end for row in rows)


def waypoint_text(make):
    header = {"frame_id": "map"}
    if make == "pose.csv":
        return lines(ROWS)
    if make == "rpy.csv":
        return "x,y,z,roll,pitch,yaw\n" + lines([(x, y, 0.0, 0.0, 0.0, yaw) for x, y, yaw in PLACES])
    if make == "semicolons.csv":
        return "x;y;yaw\n" + lines(PLACES, ";")
    if make == "crlf.csv":
        return "\ufeffx,y,yaw\r\n" + lines(PLACES, ",", "\r\n")
    if make == "path.yaml":
        path = of("nav_msgs/Path", header=header, poses=[{"header": header, "pose": posed(*place)} for place in PLACES])
        return strify_message(path) + "\n---\n"
    if make == "pose_array.yaml":
        return strify_message(of("geometry_msgs/PoseArray", header=header, poses=[posed(*place) for place in PLACES])) + "\n---\n"
    if make == "uuv.yaml":
        return "inertial_frame_id: world\nwaypoints:\n" + "".join(
            "  -\n    point: [%r, %r, 0]\n    max_forward_speed: 0.4\n    heading: %r\n    use_fixed_heading: True\n" % place
            for place in PLACES)
    if make == "zero.yaml":
        return "waypoints:\n" + "".join("  - position: {x: %r, y: %r, z: 0.0}\n    orientation: {x: 0.0, y: 0.0, z: 0.0, w: 0.0}\n"
                                        % place[:2] for place in PLACES)
    assert make == "utm.yaml", make
    return "header: {frame_id: utm}\nwaypoints:\n" + "".join(
        "  - position: {x: %r, y: %r, z: 0.0}\n    orientation: {x: 0.0, y: 0.0, z: %r, w: %r}\n" % (
            500000.0 + x, 4500000.0 + y, math.sin(yaw / 2), math.cos(yaw / 2)) for x, y, yaw in PLACES)


def waypoint_file(row, folder):
    return write(os.path.join(folder, row["make"]), waypoint_text(row["make"]))
