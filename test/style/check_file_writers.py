"""Every source that writes files has rows in the test every_writer, or a reason why not: file_writers.py names them. One that is new,
or gone, is told; so is a row that is not there, and one that no source names."""
import os
import re
import sys

from common import ROOT, finish, files, read
from file_writers import WRITERS, Without

sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "test/ros/limits")]
from commands import Commands  # noqa: E402
from storms import node_writers  # noqa: E402

COMMENT = re.compile(r"//.*")
FOLDERS = ("RunFolder", "StudyFolder")  # of runs, one a line
WRITING = re.compile(
    r"\bwrite(?:File\w+|\w+File|Waypoints|Picture|Track)\(|\bStreamedFile\b|\btoWrite\(|\b(?:FlightLog|logTo|log_\.emplace)\b"
    r"|\b(?:%s) \w+\(|\bO_CREAT\b|\bO_WRONLY\b|\bofstream\b|\bfopen\(|\bimwrite\(|\bbagmode::(?:Write|Append)" % "|".join(FOLDERS))


def writes(text):
    return WRITING.search(COMMENT.sub("", text)) is not None


def complaints(texts, writers, rows):
    for name in sorted(name for name, text in texts.items() if writes(text) and name not in writers):
        yield f"src/{name} writes files, and test/style/file_writers.py does not say which rows of every_writer ask it"
    for name, named in writers.items():
        if not writes(texts.get(name, "")):
            yield f"src/{name} of test/style/file_writers.py writes no files"
        for row in [] if isinstance(named, Without) else named.split():
            if row not in rows:
                yield f"src/{name}: every_writer has no row {row}"
    named = {row for rows_of in writers.values() if not isinstance(rows_of, Without) for row in rows_of.split()}
    for row in sorted(rows - named):
        yield f"the row {row} of every_writer is of no source in test/style/file_writers.py"


def rules():
    """What the check must find in sources that are made up."""
    new = {"x/x.cpp": "base::writeFileAtomically(file, text);"}
    for texts, writers, number in (
            (new, {"x/x.cpp": "row"}, 0), (new, {}, 2), (new, {"x/x.cpp": "row other"}, 1),
            (new, {"x/x.cpp": Without("a tool")}, 1), ({"x/x.cpp": "// writeFileAtomically(file)"}, {"x/x.cpp": "row"}, 1),
            ({"x/x.cpp": "std::ofstream out(file);"}, {"x/x.cpp": "row"}, 0)):
        told = list(complaints(texts, writers, {"row"}))
        if len(told) != number:
            yield f"{number} complaints of {texts} with {writers} are {told}"


def main():
    texts = {name[len("src/"):]: read(name) for name in files(["src"], (".cpp",))}
    rows = set(node_writers.ROWS) | {name[len("row_"):] for name in dir(Commands) if name.startswith("row_")}
    finish([*rules(), *complaints(texts, WRITERS, rows)], "%d sources, %d rows" % (len(WRITERS), len(rows)))


if __name__ == "__main__":
    main()
