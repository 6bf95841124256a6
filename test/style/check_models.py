"""What rviz shows stands where the simulator has it: the URDF models say the same as the simulator's
parameters and the world file."""
import os
import xml.etree.ElementTree

import yaml

from common import ROOT, files, finish, read


def numbers(text):
    return [float(part) for part in text.split()]


def pose_of(origin):
    return numbers(origin.get("xyz", "0 0 0")) + numbers(origin.get("rpy", "0 0 0"))


def camera_complaints():
    joint = xml.etree.ElementTree.fromstring(read("urdf/vehicle.urdf")).find("joint[@name='camera_joint']")
    parameters = yaml.safe_load(read("config/simulator.yaml"))
    wanted = [parameters["camera_" + name] for name in ("x", "y", "z", "roll", "pitch", "yaw")]
    if pose_of(joint.find("origin")) != wanted:
        yield "urdf/vehicle.urdf: camera_joint is not at camera_x ... of config/simulator.yaml, %s" % wanted


def vessel_complaints():
    shown = xml.etree.ElementTree.fromstring(read("urdf/vessel.urdf")).find("link/visual/origin")
    world = xml.etree.ElementTree.fromstring(read("worlds/dexrov_site.sdf"))
    wanted = numbers(world.find(".//model[@name='vessel']/pose").text)
    if pose_of(shown) != wanted:
        yield "urdf/vessel.urdf: the vessel is not where worlds/dexrov_site.sdf has it, %s" % wanted


def mesh_complaints(name):
    for mesh in xml.etree.ElementTree.fromstring(read(name)).iter("mesh"):
        path = mesh.get("filename").replace("package://grid_path_planner/", "")
        if not os.path.exists(os.path.join(ROOT, path)):
            yield "%s: there is no %s" % (name, path)


def main():
    names = files(("urdf",), (".urdf",))
    complaints = [complaint for name in names for complaint in mesh_complaints(name)]
    finish(complaints + list(camera_complaints()) + list(vessel_complaints()), "%d models" % len(names))


main()
