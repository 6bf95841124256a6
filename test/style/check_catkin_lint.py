"""catkin_lint finds nothing in the package but what ACCEPTED names, each with its reason.

It reads CMake without running it: what a condition, a loop or a variable decides it takes for the worst.
"""
import re
import subprocess
import xml.etree.ElementTree

from common import PLANTED, ROOT, finish, need

# Kind of a finding, a pattern of its text, why it stays.
ACCEPTED = (
    ("UNINSTALLED_SCRIPT", r"'(scripts|benchmark)/", "for a clone: builds, tests, studies, measurements"),
    ("SUBPROJECT", r"'examples'", "a package of its own, as users write one; a test builds it on the installed one"),
    ("MISSING_DIRECTORY", r"'include/grid_path_planner/", "rooms without public headers: asked by IS_DIRECTORY"),
    ("MISSING_DIRECTORY", r"devel/include'", "made by generate_messages"),
    ("EXTERNAL_INTERFACE_PATH", r"(catkin_INCLUDE_DIRS|devel/include|octomap_msgs_INCLUDE_DIRS)",
     "of libraries that nobody links from outside but by catkin, which knows these folders"),
    ("UNUSED_INCLUDE_PATH", r"'include'", "used by target_include_directories of gpp_add_room"),
    ("SHADOWED_FIND", r"OpenCV", "a test needs more of its parts than the room that it tests"),
    ("DUPLICATE_FIND", r"costmap_2d", "both adapters need it, each is found by itself"),
    ("PLUGIN_DEPEND", r"'(nav_core|mbf_costmap_core)'", "a dependency where the adapters are asked for (condition)"),
    ("UNCONFIGURED_BUILD_DEPEND", r"'(rviz|interactive_markers)'", "found where the component rviz is built"),
)


def findings():
    """(kind, text) of each."""
    answer = subprocess.run(["catkin_lint", "--offline", "--xml", "-W1", ROOT], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, universal_newlines=True)
    if "<catkin_lint" not in answer.stdout:
        raise SystemExit("catkin_lint says nothing: %s" % answer.stderr)
    root = xml.etree.ElementTree.fromstring(answer.stdout)
    return [(finding.findtext("id"), finding.findtext("text")) for finding in root]


def main():
    need("catkin_lint", "catkin-lint")
    found = findings()
    complaints = ["%s: %s" % (kind, text) for kind, text in found
                  if not any(kind == k and re.search(pattern, text) for k, pattern, _ in ACCEPTED)]
    complaints += ["ACCEPTED names %s %s, which catkin_lint does not find" % (kind, pattern)
                   for kind, pattern, _ in ACCEPTED
                   if not PLANTED and not any(kind == k and re.search(pattern, text) for k, text in found)]
    finish(complaints, "%d findings of catkin_lint" % len(found))


if __name__ == "__main__":
    main()
