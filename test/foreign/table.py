"""traits/*.yaml: what other programs publish, one row for each trait, with the right answer.

A row has
    id       a name of its own
    who      the program
    trait    what it leaves at zero, repeats, stamps or names oddly
    source   the place that it was read from: repository, file, line, function
    right    the right answer, in words
    expect   the same in values, for those that take such a thing; what the keys mean the test of that kind says
    set      fields of the right message that are changed: their path, their value (`now + 3600`: a time)
    info     the same of the CameraInfo beside an image; frames: transforms
    make     or a function of the test's that makes the messages
    ask      what is asked in another way than of the plain message
    open     {taker: why}: not right yet. It may not be right: whoever mends it takes it off here
"""
import os
import re

import yaml

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "traits")
NEEDED = {"id", "who", "trait", "source", "right", "expect"}
OPTIONAL = {"set", "info", "frames", "make", "ask", "open"}


def kinds():
    return sorted(name[:-5] for name in os.listdir(FOLDER) if name.endswith(".yaml"))


def rows(kind):
    with open(os.path.join(FOLDER, kind + ".yaml")) as file:
        table = yaml.safe_load(file)
    for row in table:
        odd = NEEDED - set(row) | set(row) - NEEDED - OPTIONAL
        if odd:
            raise ValueError("%s of %s: %s" % (row.get("id"), kind, ", ".join(sorted(odd))))
    return table


def all_rows():
    table = [(kind, row) for kind in kinds() for row in rows(kind)]
    names = [row["id"] for _, row in table]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError("twice: %s" % ", ".join(sorted(twice)))
    return table


def time_of(text, now):
    """`now`, `now - 3600`, or seconds."""
    from genpy import Duration  # the page is printed without ROS
    match = re.match(r"now(?: ([+-]) ([\d.]+))?$", str(text))
    if not match:
        return type(now).from_sec(float(text))
    by = Duration.from_sec(float(match.group(2) or "0"))
    return now - by if match.group(1) == "-" else now + by


def change(message, fields, now):
    """Sets fields of a message, named by their paths: info.origin.position.x, poses.0.header.stamp; poses.* is each of them."""
    for path, value in (fields or {}).items():
        change_one(message, path.split("."), value, now)
    return message


def change_one(part, names, value, now):
    is_list = isinstance(part, list)
    for name in range(len(part)) if is_list and names[0] == "*" else [int(names[0]) if is_list else names[0]]:
        before = part[name] if is_list else getattr(part, name)
        if names[1:]:
            change_one(before, names[1:], value, now)
            continue
        after = time_of(value, now) if hasattr(before, "to_sec") else value
        if is_list:
            part[name] = after
        else:
            setattr(part, name, after)


def expected(row, taker):
    """What `taker` answers: of `expect`, or what that has for this taker instead."""
    return row["expect"].get(taker, row["expect"])
