"""The examples build as a package of their own, which finds grid_path_planner in a devel or install space and
sees its public headers only.

    check_package.py SPACE BUILD
"""
import os
import subprocess
import sys


def run(*command):
    print(" ".join(command), flush=True)
    subprocess.run(command, check=True)


def main():
    space, build = (os.path.abspath(folder) for folder in sys.argv[1:])
    run("cmake", "-S", "examples", "-B", build, "-DCMAKE_PREFIX_PATH=" + space, "-DCMAKE_BUILD_TYPE=Debug",
        "-DPYTHON_EXECUTABLE=" + sys.executable)
    run("cmake", "--build", build)
    run(os.path.join(build, "devel/lib/grid_path_planner_examples/2_costs_and_inflation"))


main()
