"""Tests that are left out are told: scripts/missing_tools names each tool that a machine lacks, and on Debian 12
scripts/test ends there.

Machines without a tool are made by a folder of links to all other programs as the only PATH.
"""
import os
import subprocess
import tempfile

from common import ROOT, finish

TOOLS = {
    "MPI": ("mpirun", "mpicxx"),
    "Chromium": ("chromium", "chromium-browser", "google-chrome"),
    "Xvfb": ("Xvfb",),
    "xdotool": ("xdotool",),
    "rviz": ("rviz",),
    "clang-format": ("clang-format", "clang-format-14"),
    "shellcheck": ("shellcheck",),
    "catkin_lint": ("catkin_lint",),
}


def link_all_but(names, folder):
    """Of a program without a link all that is asked is whether it is there: where a tool itself is absent here, one
    that stands for it is made."""
    for place in ("/bin", "/usr/bin"):
        for program in os.listdir(place):
            if program not in names and not os.path.lexists(os.path.join(folder, program)):
                os.symlink(os.path.join(place, program), os.path.join(folder, program))
    for tool in TOOLS.values():
        for program in tool:
            if program not in names and not os.path.lexists(os.path.join(folder, program)):
                os.symlink("/bin/true", os.path.join(folder, program))


def answer(command, path, **environment):
    return subprocess.run(command, cwd=ROOT, env=dict(os.environ, PATH=path, **environment), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)


def complaints_without(tool, names, root, release):
    with tempfile.TemporaryDirectory() as folder:
        link_all_but(names, folder)
        missing = answer(["scripts/missing_tools", root], folder).stdout.split()
        if missing != ([tool] if tool else []):
            yield "without %s scripts/missing_tools says %s" % (tool, missing)
        if not names:
            return
        tested = answer(["scripts/test", "--no-install"], folder, OS_RELEASE=release)
        if tested.returncode == 0 or "these are missing: %s;" % tool not in tested.stdout:
            yield "without %s scripts/test says %s" % (tool, tested.stdout)


def main():
    complaints = []
    with tempfile.TemporaryDirectory() as root:
        release = os.path.join(root, "os-release")
        with open(release, "w", encoding="utf-8") as file:
            file.write("VERSION_CODENAME=bookworm\n")
        complaints += complaints_without("gtest", (), root, release)
        os.makedirs(os.path.join(root, "usr/include/gtest"))
        with open(os.path.join(root, "usr/include/gtest/gtest.h"), "w", encoding="utf-8"):
            pass
        for tool, names in [("", ())] + sorted(TOOLS.items()):
            complaints += complaints_without(tool, names, root, release)
    finish(complaints, "%d tools" % (len(TOOLS) + 1))


main()
