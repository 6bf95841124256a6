"""A screen without a monitor (Xvfb), looked at by its pixels and used by a mouse and a keyboard (xdotool).

    with Screen(1440, 960) as screen:
        subprocess.Popen(["rviz"], env=screen.environment)
        box = screen.look().box_of((11, 95, 165), least_width=40)    # of a colour
        screen.click(box.middle())
        screen.look().write_png("seen.png")
"""
import collections
import os
import shutil
import struct
import subprocess
import tempfile
import zlib

HEADER_BYTES = 100  # of an XWD file, 25 numbers of 4 bytes


class Box(collections.namedtuple("Box", "left top right bottom")):
    """Pixels; right and bottom belong to it."""

    def middle(self):
        return (self.left + self.right) // 2, (self.top + self.bottom) // 2

    def at(self, u, v):
        """The pixel at these shares, 0...1, of its width and height."""
        return round(self.left + u * (self.right - self.left)), round(self.top + v * (self.bottom - self.top))


class Picture:
    """What an XWD file of 32 bits a pixel holds."""

    def __init__(self, data):
        header = struct.unpack(">25I", data[:HEADER_BYTES])
        self.width, self.height, self.line = header[4], header[5], header[12]
        self.begin = header[0] + 12 * header[19]
        self.data = data

    def row(self, y):
        begin = self.begin + y * self.line
        row = bytearray(self.data[begin:begin + 4 * self.width])
        row[3::4] = bytes(self.width)  # no colour
        return row

    def box_of(self, colour, least_width):
        """Around all rows in which that many pixels of the colour stand side by side; None where there is none."""
        run = bytes((colour[2], colour[1], colour[0], 0)) * least_width
        lefts, rights, rows = [], [], []
        for y in range(self.height):
            row = self.row(y)
            left = row.find(run)
            if left >= 0:
                lefts.append(left // 4)
                rights.append(row.rfind(run) // 4 + least_width - 1)
                rows.append(y)
        return Box(min(lefts), rows[0], max(rights), rows[-1]) if rows else None

    def colours(self, box):
        """How many there are in the box."""
        rows = (self.row(y) for y in range(box.top, box.bottom + 1))
        return len({bytes(row[4 * x:4 * x + 3]) for row in rows for x in range(box.left, box.right + 1)})

    def write_png(self, name):
        lines = []
        for y in range(self.height):
            row, line = self.row(y), bytearray(3 * self.width)
            line[0::3], line[1::3], line[2::3] = row[2::4], row[1::4], row[0::4]
            lines.append(b"\0" + bytes(line))

        def chunk(kind, content):
            return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
        with open(name, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0))
                       + chunk(b"IDAT", zlib.compress(b"".join(lines), 9)) + chunk(b"IEND", b""))


class Screen:
    def __init__(self, width, height):
        self.folder = tempfile.mkdtemp()
        number, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "%dx%dx24" % (width, height), "-fbdir", self.folder,
             "-nolisten", "tcp"], pass_fds=(write_end,), stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(number) as told:
            display = told.readline().strip()
        if not display:
            raise RuntimeError("Xvfb did not start")
        self.environment = dict(os.environ, DISPLAY=":" + display, LIBGL_ALWAYS_SOFTWARE="1", XDG_RUNTIME_DIR=self.folder)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder)

    def look(self):
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            return Picture(file.read())

    def do(self, *words):
        """xdotool's commands, one after the other."""
        subprocess.run(["xdotool"] + [str(word) for word in words], env=self.environment, check=True,
                       stdout=subprocess.DEVNULL)

    def click(self, pixel):
        self.do("mousemove", *pixel, "sleep", 0.1, "click", 1)

    def drag(self, begin, end):
        middle = [(a + b) // 2 for a, b in zip(begin, end)]
        self.do("mousemove", *begin, "sleep", 0.2, "mousedown", 1, "sleep", 0.2, "mousemove", *middle, "sleep", 0.2,
                "mousemove", *end, "sleep", 0.2, "mouseup", 1)

    def key(self, name):
        self.do("key", name)
