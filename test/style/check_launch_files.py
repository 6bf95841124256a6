"""Every launch file can be loaded and is installed, its nodes exist and are started again when they end, and it sets no
parameter that its node lacks."""
import functools
import os
import re

import roslaunch.arg_dump
import roslaunch.config
import roslib.packages
import yaml

from common import ROOT, files, finish, read

PACKAGE = "grid_path_planner"
WINDOWS = ("rviz_on_map",)  # whoever closes one wants it closed
MAP = "map:=maps/dexrov_site.yaml"
ARGUMENTS = {"map_file.launch": [MAP], "map_demo.launch": [MAP], "two_vehicles.launch": [MAP], "vehicle.launch": ["name:=a"]}


@functools.lru_cache(maxsize=None)
def known_parameters(node):
    return set(yaml.safe_load(read("config/%s.yaml" % node)) or {})


def complaints_of(name):
    file = os.path.join(ROOT, name)
    try:
        config = roslaunch.config.load_config_default(
            [(file, ARGUMENTS.get(os.path.basename(name), []))], None, verbose=False)
    except Exception as error:  # roslaunch has a class of its own for nearly every mistake
        return ["%s: %s" % (name, error)]
    complaints = ["%s: %s" % (name, error) for error in config.config_errors]
    for node in config.nodes:
        if node.package != PACKAGE:
            continue
        if not roslib.packages.find_node(PACKAGE, node.type):
            complaints.append("%s: there is no executable %s" % (name, node.type))
        if not node.respawn and node.type not in WINDOWS:
            complaints.append("%s: %s is not started again when it ends: respawn" % (name, node.name))
        prefix = "%s%s/" % (node.namespace, node.name)
        for parameter in config.params:
            if parameter.startswith(prefix) and "/" not in parameter[len(prefix):]:
                if parameter[len(prefix):] not in known_parameters(node.type):
                    complaints.append("%s: %s has no parameter %s"
                                      % (name, node.type, parameter[len(prefix):]))
    return complaints


def undocumented(name):
    """The arguments without a doc attribute, as `roslaunch --ros-args` finds them."""
    arguments = roslaunch.arg_dump.get_args([os.path.join(ROOT, name)])
    return ["%s: argument %s is undocumented" % (name, argument) for argument, (doc, _) in arguments.items() if not doc]


def not_installed(names):
    """cmake/components.cmake lists them by component."""
    lists = re.findall(r"GPP_LAUNCH_FILES ([^)]*)\)", read("cmake/components.cmake"))
    listed = {name for words in lists for name in words.split()}
    return ["%s: cmake/components.cmake does not install it" % name for name in names
            if os.path.basename(name)[:-len(".launch")] not in listed]


def main():
    names = files(("launch",), (".launch",))
    finish(not_installed(names) + [complaint for name in names for complaint in complaints_of(name) + undocumented(name)],
           "%d launch files" % len(names))


main()
