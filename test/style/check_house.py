"""The house in numbers: how many public headers, how large folders, files and functions are, and that no
type has two definitions in one namespace.

    check_house.py --list     also prints the largest of each kind
"""
import collections
import os
import re
import subprocess
import sys

from common import PLANTED, ROOT, files, finish, lacking, read, version_of

# What is counted: the limit that is enforced, and the target of the layout where that is lower.
# A limit is lowered in the commit that makes it possible, and never raised.
LIMITS = {
    "public headers": (85, 85),
    "files in the largest folder": (35, 35),
    "lines of the longest file": (400, 400),
    "functions of 20 lines and more, in a thousand": (50, 50),
}
LONGEST_FUNCTION = 60  # lines, but for
HOT_LOOPS = {  # measured: slower in pieces
    "BucketSearch::search",
}

CODE = ("include", "src")
FOLDERS = CODE + ("test", "benchmark", "examples", "scripts", "cmake", "config", "launch", "doc", "msg", "srv", "action")
ENDINGS = (".h", ".cpp", ".py")
TYPES = ("class", "struct", "union", "enum", "typedef")


def tags():
    """Every definition that universal-ctags finds: a dict of its fields."""
    command = ["ctags", "--languages=C++", "--c++-kinds=fcsgut", "--fields=+neKZ", "-L", "-", "-o", "-"]
    answer = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True,
                            input="\n".join(files(CODE, (".h", ".cpp"))))
    for line in answer.stdout.splitlines():
        name, file, rest = line.split("\t", 2)
        fields = rest.rsplit(';"\t', 1)[1].split("\t")
        tag = dict(field.split(":", 1) for field in fields[1:])
        tag.update(name=name, file=file, kind=fields[0].replace("kind:", ""))
        yield tag


def functions(found):
    """(lines, name with its class, place) of every function, longest first; comments inside count."""
    lengths = []
    for tag in found:
        if tag["kind"] == "function" and "end" in tag:
            kind, _, scope = tag.get("scope", "").partition(":")
            owner = scope.split("::")[-1] + "::" if kind in ("class", "struct") else ""
            lengths.append((int(tag["end"]) - int(tag["line"]) + 1, owner + tag["name"],
                            "%s:%s" % (tag["file"], tag["line"])))
    return sorted(lengths, reverse=True)


def types_twice(found):
    """Types that two files define in one namespace or class. Anonymous namespaces are one a file."""
    places = collections.defaultdict(set)
    for tag in found:
        if tag["kind"] in TYPES and not tag["name"].startswith("__anon"):
            scope = tag.get("scope", "").split(":", 1)[-1]
            places["%s::%s" % (scope, tag["name"])].add(tag["file"])
    return {name: sorted(where) for name, where in places.items() if len(where) > 1}


def folder_sizes():
    sizes = collections.Counter(os.path.dirname(name) for name in files(FOLDERS, ("",))
                                if not re.search(r"__pycache__|\.stl$|\.dae$", name))
    return sorted(((count, name) for name, count in sizes.items()), reverse=True)


def file_lengths():
    return sorted(((len(read(name).splitlines()), name)
                   for name in files(FOLDERS, ENDINGS)), reverse=True)


def main():
    if "Universal Ctags" not in (version_of("ctags") or ""):
        lacking("no universal-ctags: apt-get install universal-ctags")
    found = list(tags())
    lengths, folders, texts = functions(found), folder_sizes(), file_lengths()
    headers = files(("include",), (".h",))
    long_ones = sum(1 for length, _, _ in lengths if length >= 20)
    counts = {
        "public headers": (len(headers), ""),
        "files in the largest folder": folders[0],
        "lines of the longest file": texts[0],
        "functions of 20 lines and more, in a thousand":
            (-(-1000 * long_ones // max(len(lengths), 1)), "%d of %d" % (long_ones, len(lengths))),
    }
    complaints = ["%s: %d, more than %d: %s" % (what, count, LIMITS[what][0], where)
                  for what, (count, where) in counts.items() if count > LIMITS[what][0]]
    over = {name: (length, place) for length, name, place in lengths if length > LONGEST_FUNCTION}
    complaints += ["%s: %s has %d lines, more than %d" % (place, name, length, LONGEST_FUNCTION)
                   for name, (length, place) in over.items() if name not in HOT_LOOPS]
    if not PLANTED:
        complaints += ["%s is not above %d lines: strike it from check_house.py" %
                       (name, LONGEST_FUNCTION) for name in sorted(HOT_LOOPS - set(over))]
    twice = types_twice(found)
    complaints += ["%s is defined in %s" % (name, " and in ".join(where))
                   for name, where in sorted(twice.items())]
    if "--list" in sys.argv:
        for title, rows in (("functions", lengths), ("folders", folders), ("files", texts)):
            print("\n".join([title] + ["  %d %s" % (row[0], " ".join(row[1:])) for row in rows[:12]]))
    report = ["%s: %d (limit %d, target %d)" % ((what, count) + LIMITS[what])
              for what, (count, _) in counts.items()]
    report.append("functions above %d lines: %d, of them hot loops %d" %
                  (LONGEST_FUNCTION, len(over), len(HOT_LOOPS & set(over))))
    report.append("types with two definitions: %d" % len(twice))
    finish(complaints, "%d functions (%s)" % (len(lengths), "; ".join(report)))


main()
