# Sourced by the other scripts: the repository's root in $root, the names of all components in $all_components, and
# an environment to build in.
# shellcheck shell=bash disable=SC2034
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
read -ra all_components <<< "$(sed -n 's/^set(GPP_ALL_COMPONENTS \(.*\))$/\1/p' "$root/cmake/components.cmake")"

# ROS's Python modules belong to the system's Python, whatever other Python comes first in PATH.
export PATH="/usr/bin:$PATH"

# The setup files of ROS read variables that may not be set.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

if [ -f /opt/ros/noetic/setup.bash ]; then
  source_setup /opt/ros/noetic/setup.bash
fi
