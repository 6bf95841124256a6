#!/usr/bin/env python3
"""Prints doc/foreign.md of the table in traits/, or with --check says whether the page is that one."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import table

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "doc", "foreign.md")
TITLES = {"maps": "Maps", "updates": "Updates of maps", "map_files": "Map files", "poses": "Goals", "paths": "Paths", "waypoint_files": "Waypoint files",
          "actions": "Goals of actions", "scans": "Scans", "clouds": "Clouds", "images": "Images", "navigation": "Navigation sensors",
          "transforms": "Transforms", "joysticks": "Joysticks", "parameters": "Parameters",
          "vehicles": "Vehicles", "octrees": "Octrees"}
TAKERS = {"maps": "`path_planner`, `navigate_path`, `map_layers` (as static and as live map), `map_publisher`, `grid_path plan` of a bag and of a dump",
          "updates": "`path_planner`, `navigate_path`, `map_layers`",
          "map_files": "`grid_path plan`, `map_publisher`", "poses": "`path_planner` (topic, service, action), `go_to_pose` (action, topic)",
          "paths": "`navigate_path` (topic, action), `local_planner` (action)", "waypoint_files": "`grid_path waypoints`, goals of `navigate_path` and `local_planner`",
          "actions": "`navigate_path`, `local_planner`, `go_to_pose`", "scans": "`map_layers`", "clouds": "`projected_map`",
          "images": "`marker_localizer`", "navigation": "`vehicle_localizer`", "transforms": "`path_planner`, `navigate_path`",
          "joysticks": "`teleop_joy`", "parameters": "`path_planner`, `navigate_path`, `go_to_pose`, `teleop_joy`", "vehicles": "`navigate_path`",
          "octrees": "`grid_path project`, `projected_map`"}
BEGINNING = """# What others publish

What other programs leave at zero, repeat, stamp or name oddly, where that was read, and what this package makes of it. What can
mean one thing only is taken as it is meant, and told once; what cannot is refused with a sentence. The page is printed from
`test/foreign/traits/` by `test/foreign/write_page.py`. The tests send each row to what its section names.

%d rows: %d are taken, %d are refused%s. Tests send them all.
"""


def is_refused(row):
    return "refused" in row["expect"]


def cell(text):
    return re.sub(r"\s+", " ", str(text)).replace("|", "\\|").replace("<", "&lt;").replace("_", "\\_").replace("*", "\\*")


def page():
    rows = [row for _, row in table.all_rows()]
    refused = sum(map(is_refused, rows))
    opened = sum("open" in row for row in rows)
    text = BEGINNING % (len(rows), len(rows) - refused, refused, "; not yet right: %d" % opened if opened else "")
    for kind in TITLES:
        text += "\n## %s\n\nTo %s.\n\n| who | what | here | read in |\n|---|---|---|---|\n" % (
            TITLES[kind], TAKERS[kind])
        for row in table.rows(kind):
            mark = " (not yet: %s)" % ", ".join(sorted(row["open"])) if "open" in row else ""
            text += "| %s | %s | %s%s | %s |\n" % (cell(row["who"]), cell(row["trait"]), cell(row["right"]), cell(mark), cell(row["source"]))
    return text


def main():
    if "--check" not in sys.argv:
        with open(PAGE, "w") as file:
            file.write(page())
        return
    missing = set(table.kinds()) ^ set(TITLES)
    with open(PAGE) as file:
        if file.read() != page() or missing:
            sys.exit("doc/foreign.md is not what test/foreign/write_page.py prints; run it %s" % " ".join(sorted(missing)))


if __name__ == "__main__":
    main()
