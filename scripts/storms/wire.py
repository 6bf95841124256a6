"""Two network namespaces and a packet forwarder between them, which loses, delays or cuts.

    with Wire() as wire:         # NotRun where namespaces or TAP devices may not be made
        wire.enter(0)            # this process and its children are in the first namespace
        wire.loss, wire.delay, wire.is_cut = 0.2, 0.0, False
"""
import collections
import ctypes
import fcntl
import os
import random
import select
import struct
import subprocess
import threading
import time

from .session import NotRun

TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
CLONE_NEWNET = 0x40000000
LARGEST_FRAME = 65536


def ip(*words):
    answer = subprocess.run(["ip", *words], capture_output=True, text=True)
    if answer.returncode != 0:
        raise NotRun("ip %s: %s" % (" ".join(words), answer.stderr.strip()))


def open_tap(name):
    try:
        tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(tap, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TAP | IFF_NO_PI))
    except OSError as error:
        raise NotRun("no TAP device: %s" % error)
    return tap


class Wire:
    def __init__(self):
        self.loss, self.delay, self.is_cut, self.done = 0.0, 0.0, False, False
        self.names = ["gpp%d_%d" % (os.getpid() % 100000, side) for side in range(2)]
        self.addresses = ["10.237.%d.%d" % (os.getpid() % 250, side + 1) for side in range(2)]
        self.random = random.Random(1)
        self.taps, self.made, self.forwarded = [], [], 0

    def __enter__(self):
        try:
            for name, address in zip(self.names, self.addresses):
                ip("netns", "add", name)
                self.made.append(name)
                self.taps.append(open_tap(name))
                ip("link", "set", name, "netns", name)
                ip("-n", name, "addr", "add", address + "/24", "dev", name)
                ip("-n", name, "link", "set", name, "up")
                ip("-n", name, "link", "set", "lo", "up")
        except (NotRun, OSError):
            self.__exit__()
            raise
        self.thread = threading.Thread(target=self.forward, daemon=True)
        self.thread.start()
        return self

    def enter(self, side):
        with open("/var/run/netns/" + self.names[side]) as namespace:
            if ctypes.CDLL(None, use_errno=True).setns(namespace.fileno(), CLONE_NEWNET) != 0:
                raise NotRun("setns: " + os.strerror(ctypes.get_errno()))

    def forward(self):
        waiting = collections.deque()  # (due, tap, frame)
        while not self.done:
            ready, _, _ = select.select(self.taps, [], [], 0.005)
            for tap in ready:
                self.take(tap, waiting)
            while waiting and waiting[0][0] <= time.monotonic():
                _, tap, frame = waiting.popleft()
                self.forwarded += 1
                try:
                    os.write(tap, frame)
                except OSError:
                    pass  # a frame that is lost

    def take(self, tap, waiting):
        other = self.taps[1 - self.taps.index(tap)]
        for _ in range(100):
            try:
                frame = os.read(tap, LARGEST_FRAME)
            except OSError:
                return
            if not self.is_cut and self.random.random() >= self.loss:
                waiting.append((time.monotonic() + self.delay, other, frame))

    def __exit__(self, *_):
        self.done = True
        for tap in self.taps:
            os.close(tap)
        for name in self.made:
            subprocess.run(["ip", "netns", "del", name])
