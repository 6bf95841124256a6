# Completion for `grid_path` and `rosrun grid_path_planner grid_path`: commands, options and their values; else files.
# Sourced with setup.bash. What there is to complete, the program itself says.
# shellcheck shell=bash

# The words after `grid_path`, up to the one under the cursor, and the command line that starts the program.
_grid_path_completions() {
  local -a program words
  local place=$1
  program=("${COMP_WORDS[@]:0:place}")
  words=("${COMP_WORDS[@]:place:COMP_CWORD-place+1}")
  local current=${words[-1]} previous='' candidates
  if [ ${#words[@]} -ge 2 ]; then previous=${words[-2]}; fi
  if [ ${#words[@]} -le 1 ]; then
    candidates=$("${program[@]}" --help 2> /dev/null | awk '/^  [a-z]/ { print $1 }')
    candidates+=" --help --version"
  elif [[ $current == -* ]]; then
    candidates=$("${program[@]}" "${words[0]}" --complete 2> /dev/null | cut -d ' ' -f 1)
  else
    candidates=$("${program[@]}" "${words[0]}" --complete 2> /dev/null |
      awk -v name="$previous" '$1 == name { $1 = ""; print }')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$candidates" -- "$current")
}

_grid_path() { _grid_path_completions 1; }

# rosrun's own completion, but for our program.
_grid_path_rosrun() {
  if [ "$COMP_CWORD" -gt 2 ] && [ "${COMP_WORDS[1]}" = grid_path_planner ] && [ "${COMP_WORDS[2]}" = grid_path ]; then
    _grid_path_completions 3
  elif declare -F _roscomplete_exe > /dev/null; then
    _roscomplete_exe "$@"
  fi
}

if [[ $- == *i* ]]; then
  complete -o default -F _grid_path grid_path
  complete -o default -F _grid_path_rosrun rosrun
fi
