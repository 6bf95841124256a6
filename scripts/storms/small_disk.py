"""A disk of a few MB that may be full or read-only: a file system in memory, for which one must be allowed to mount.

    with SmallDisk(os.path.join(folder, "kept")) as disk:
        with disk.trouble("full"):
            ...
"""
import contextlib
import os
import re
import subprocess
import sys
import time

from .session import NotRun

TROUBLES = {"full": "No space left on device", "read-only": "Read-only file system"}
PAGE = 4096  # bytes, which each file takes a whole number of
FREE_SECONDS = 5.0  # for what is being written when the disk is made read-only
TEMPORARY = re.compile(r"^\..*\.tmp[0-9a-f]{16}$")
OWN_MOUNTS = "GPP_OWN_MOUNTS"


def enter_own_mounts():
    """This program from its begin, with mounts that nobody else sees and that end with it, where the system grants that."""
    for command in (["unshare", "--mount"], ["unshare", "--map-root-user", "--mount"]):
        if OWN_MOUNTS in os.environ:
            return
        with contextlib.suppress(OSError):
            if subprocess.run(command + ["true"], stderr=subprocess.DEVNULL).returncode == 0:
                os.environ[OWN_MOUNTS] = "1"
                os.execvp(command[0], command + [sys.executable] + sys.argv)


def mount(*words):
    answer = subprocess.run(["mount", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    if answer.returncode != 0:
        raise NotRun("mount: " + answer.stdout.strip())


def make_read_only(folder):
    deadline = time.monotonic() + FREE_SECONDS
    while True:
        try:
            return mount("-o", "remount,ro", folder)
        except NotRun:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.02)


class SmallDisk:
    def __init__(self, folder, kilobytes=65536):
        self.folder, self.kilobytes = folder, kilobytes
        self.filler = os.path.join(folder, "filler")

    def __enter__(self):
        os.mkdir(self.folder)
        mount("-t", "tmpfs", "-o", "size=%dk" % self.kilobytes, "tmpfs", self.folder)
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", "-l", self.folder])

    def fill(self):
        """What room there is, or has become free again: what was being written while it became full is removed."""
        with open(self.filler, "ab", buffering=0) as file, contextlib.suppress(OSError):
            while True:
                file.write(bytes(PAGE))

    def give_room(self, pages):
        os.truncate(self.filler, os.path.getsize(self.filler) - PAGE * pages)

    @contextlib.contextmanager
    def trouble(self, kind):
        if kind == "full":
            self.fill()
        else:
            make_read_only(self.folder)
        try:
            yield
        finally:
            if kind == "full":
                os.unlink(self.filler)
            else:
                mount("-o", "remount,rw", self.folder)

    def contents(self):
        """{name: bytes} of what lies there, but for what fills it."""
        found = {}
        for folder, _, names in os.walk(self.folder):
            for name in names:
                path = os.path.join(folder, name)
                if path != self.filler:
                    with contextlib.suppress(FileNotFoundError), open(path, "rb") as file:
                        found[os.path.relpath(path, self.folder)] = file.read()
        return found

    def temporaries(self):
        return [name for name in self.contents() if TEMPORARY.match(os.path.basename(name))]
