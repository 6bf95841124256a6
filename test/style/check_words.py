"""Words of our own that do not come back where the field has a term: in names, identifiers and comments
of C++ files, in documents, configuration and messages. doc/glossary.md says what the terms mean.
"""
import os
import re

from common import ROOT, files, finish, read

# Words as written with underscores; CamelCase is found too. Single words are found as wholes.
WORDS = {
    "brick_marks": "scan marks",
    "brick_walk": "sparse ray traversal",
    "canonical_steps": "natural moves",
    "catalogue": "factory, list",
    "centre_segment": "line of sight",
    "cheaper_places": "cost decreases",
    "cheapest": "minimum weight, least cost",
    "cone": "interval, interval node",
    "cone_search": "Polyanya search",
    "costs_from": "shortest-path tree",
    "dear": "of high cost, of high weight",
    "dearer": "costlier, of higher cost",
    "dearest": "of largest weight",
    "desk": "server",
    "detour": "repair search, path around",
    "eight_cells": "SIMD neighbourhood",
    "follow_way": "swept sphere",
    "glide": "flat successors",
    "goal_labels": "backward nodes",
    "goal_tree": "backward search tree",
    "inquiry": "ticket",
    "jump_lanes": "straight jump table",
    "jump_maps": "jump-point bitmaps",
    "jump_nodes": "hashed nodes, radix heap",
    "jump_tiles": "diagonal jump bits",
    "keeper": "model",
    "kept_goal": "active goal",
    "label_lines": "inconsistency scan",
    "map_keeper": "map model",
    "map_turns": "double buffering",
    "mapping_desk": "mapping thread",
    "natural_steps": "natural moves",
    "near_obstacles": "bounded distance transform",
    "needless": "unnecessary",
    "patient_queue": "heap-on-top queue",
    "plan_attempt": "path planner",
    "plan_desk": "planning server",
    "plan_engine": "planning server",
    "plan_worker": "task queue",
    "prepared_table": "precomputed table",
    "rectangle_answer": "rectangles result",
    "rectangle_question": "rectangles request",
    "rectangle_telling": "rectangles output",
    "rising_keys": "D* keys with key modifier",
    "route_finder": "multi-resolution planner",
    "saw_the_end": "left the tree",
    "segment_legal": "line of sight",
    "sphere_way": "swept sphere",
    "straight_cost": "line cost",
    "symmetry_sample": "pruning estimate",
    "table_entry": "compact cost",
    "take_cheaper": "on cost decrease",
    "take_dearer": "on cost increase",
    "taut_search": "Anya search",
    "terrain": "costmap",
    "tile_flood": "tiled Dijkstra",
    "too_dear": "too expensive",
    "undo_float": "float round trip",
    "waiting_cells": "tiled open list",
    "wake": "mark inconsistent",
    "way": "path, direction, method",
    "window_walk": "dense ray traversal",
}

# The value of the option heuristic_scale stands in users' files.
VALUE = re.compile(r"""(["'`])cheapest\1|heuristic_scale: cheapest""")

CODE = ("include", "src", "test", "benchmark", "examples")
PAGES = ("doc", "config", "launch", "maps", "msg", "srv", "action")
PAGE_ENDINGS = (".md", ".rst", ".yaml", ".launch", ".msg", ".srv", ".action")


def pattern(word):
    """As goal_tree, GOAL_TREE, goalTree, GoalTree; a single word alone or as a part of such a name, but not
    as a part of another word: WAYPOINT, always.
    """
    parts = word.split("_")
    camel = "".join(part.capitalize() for part in parts)
    start = "(?<![A-Za-z])" if len(parts) == 1 else ""
    plural = "s?"
    return re.compile("%s(%s%s(?![a-z])|%sS?(?![A-Za-z]))|%s%s(?![a-z])" % (
        start, word, plural, word.upper(), camel, plural)
        + ("" if len(parts) == 1 else "|%s(?![a-z])" % (camel[0].lower() + camel[1:] + plural)))


def texts():
    """Names of the files that are read."""
    pages = [name for name in sorted(os.listdir(ROOT)) if name.endswith(PAGE_ENDINGS)]
    return files(CODE, (".h", ".cpp")) + files(PAGES, PAGE_ENDINGS) + pages


def occurrences():
    """(word, file, line number) of all."""
    patterns = [(word, word.replace("_", ""), pattern(word)) for word in sorted(WORDS)]
    for name in texts():
        for number, line in enumerate([os.path.basename(name)] + VALUE.sub("", read(name)).splitlines()):
            letters = line.lower().replace("_", "")
            for word, its_letters, expression in patterns:
                if its_letters in letters and expression.search(line):
                    yield word, name, number


def main():
    finish(["%s:%d: '%s': the field says %s" % (name, number, word, WORDS[word])
            for word, name, number in occurrences()], "%d words" % len(WORDS))


main()
