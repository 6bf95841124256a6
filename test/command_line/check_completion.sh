#!/usr/bin/env bash
# What the completion of grid_path offers, asked as bash asks it.
#
#   check_completion.sh GRID_PATH HOOK
set -euo pipefail
grid_path=$1
# shellcheck source=env-hooks/50.grid_path_planner.bash
source "$2"
failed=0

# offered FUNCTION WORD...: what is offered for the last word.
offered() {
  local function=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  "$function"
  echo "${COMPREPLY[*]}"
}

expect() {
  if [ "$1" != "$2" ]; then
    echo "expected '$2', got '$1'"
    failed=1
  fi
}

expect "$(offered _grid_path "$grid_path" pl)" "plan"
expect "$(offered _grid_path "$grid_path" --v)" "--version"
expect "$(offered _grid_path "$grid_path" plan --radius)" "--radius --radius-to-unknown"
expect "$(offered _grid_path "$grid_path" plan --cells --planner weig)" "weighted_jump_point"
expect "$(offered _grid_path "$grid_path" plan --retry-finer '')" "true false"
expect "$(offered _grid_path "$grid_path" plan --map '')" ""
# shellcheck disable=SC2317
rosrun() { shift 2; "$grid_path" "$@"; }
expect "$(offered _grid_path_rosrun rosrun grid_path_planner grid_path scen)" "scenarios"
expect "$(offered _grid_path_rosrun rosrun other grid_path scen)" ""
exit $failed
