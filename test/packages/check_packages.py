"""The package of a component: what it says it needs, what is in it, and that what is in it runs elsewhere.

    check_packages.py CPACK BUILD_FOLDER

That of driving is made and unpacked into an empty folder, not installed; planning, which it needs, is installed beside
it. Of the programs there no library may come from the build folder, and ROS finds the package there.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile

PACKAGE = "grid_path_planner"
PREFIX = "/opt/ros/noetic" if os.path.isdir("/opt/ros/noetic") else "/usr"
NEEDED = r".*grid-path-planner-planning \(= [0-9.]+\)", r"libc6 \(.*\)", r"libstdc\+\+6 \(.*\)", r"lib(boost|roscpp|ros).*"
FILES = {"planning": ("lib/%s/path_planner", "share/%s/package.xml", "share/%s/launch/planner.launch",
                      "share/%s/msg/PlanRecord.msg", "share/%s/config/path_planner.yaml", "lib/lib%s_planning.so"),
         "driving": ("lib/%s/navigate_path", "share/%s/launch/go_to.launch", "lib/lib%s_ros_driving.so",
                     "include/%s/following/path_follower.h")}


def output(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, universal_newlines=True, **options).stdout


def make(cpack, build, folder):
    """The .deb of driving."""
    log = subprocess.run([cpack, "-G", "DEB", "--config", os.path.join(build, "CPackConfig.cmake"), "-B", folder,
                          "-D", "CPACK_COMPONENTS_ALL=driving", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip"],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    names = glob.glob(os.path.join(folder, "*grid-path-planner-driving_*.deb"))
    if log.returncode != 0 or len(names) != 1:
        sys.exit("cpack made %s:\n%s" % (names or "no package", log.stdout))
    return names[0]


def missing_dependencies(package):
    names = output("dpkg-deb", "-f", package, "Depends").strip().split(", ")
    return ["driving does not depend on %s, but on %s" % (pattern, names) for pattern in NEEDED
            if not any(re.fullmatch(pattern, name) for name in names)]


def files_below(folder):
    return {os.path.relpath(os.path.join(path, name), folder + PREFIX)
            for path, _, names in os.walk(folder) for name in names}


def misplaced(folders):
    """Files of one component in the package of the other, and files that should be there."""
    found = {component: files_below(folder) for component, folder in folders.items()}
    for name in sorted(found["planning"] & found["driving"]):
        yield "%s is in both packages" % name
    for component, names in FILES.items():
        for name in names:
            if name % PACKAGE not in found[component]:
                yield "%s is not in the package of %s" % (name % PACKAGE, component)


def foreign_libraries(folders, build):
    """Libraries of the programs that are missing, or come from the build folder."""
    libraries = ":".join(folder + PREFIX + "/lib" for folder in folders.values())
    for component, program in (("planning", "path_planner"), ("driving", "navigate_path")):
        file = os.path.join(folders[component] + PREFIX, "lib", PACKAGE, program)
        for line in output("ldd", file, env={"PATH": os.environ["PATH"], "LD_LIBRARY_PATH": libraries}).splitlines():
            if "not found" in line or build in line:
                yield "%s: %s" % (program, line.strip())


def not_found_by_ros(folder):
    environment = {"PATH": os.environ["PATH"], "HOME": folder, "ROS_ROOT": os.environ.get("ROS_ROOT", "/usr/share/ros"),
                   "ROS_PACKAGE_PATH": folder + PREFIX + "/share", "ROSPACK_CACHE_TIMEOUT": "0"}
    place = output("rospack", "find", PACKAGE, env=environment).strip()
    if not os.path.samefile(place, folder + PREFIX + "/share/" + PACKAGE):
        yield "ROS finds the package at %s" % place


def main():
    cpack, build = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        folders = {component: os.path.join(folder, component) for component in ("planning", "driving")}
        package = make(cpack, build, folder)
        subprocess.run(["dpkg-deb", "-x", package, folders["driving"]], check=True)
        output("cmake", "--install", build, "--component", "planning", "--prefix", folders["planning"] + PREFIX)
        complaints = missing_dependencies(package) + list(misplaced(folders))
        complaints += list(foreign_libraries(folders, build)) + list(not_found_by_ros(folders["planning"]))
    for complaint in complaints:
        print(complaint)
    sys.exit(1 if complaints else 0)


main()
