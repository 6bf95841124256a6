"""Every planner finds the paths that it found when test/data/path_hashes.txt was recorded.

    check_path_hashes.py GRID_PATH FOLDER [--record]

Draws three small maps with queries into FOLDER, and compares what scripts/path_hashes prints of them and of maps/
with the file. --record writes the file instead, for a commit that changes paths on purpose and says so.
"""
import difflib
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
EXPECTED = os.path.join("test", "data", "path_hashes.txt")
QUERIES = 20


class Random:
    """Knuth's MMIX generator: the same numbers by every version of Python."""

    def __init__(self, seed):
        self.state = seed

    def below(self, limit):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2 ** 64
        return (self.state >> 33) % limit


def noise(random):
    """Single cells, one in five."""
    return [["@" if random.below(5) == 0 else "." for _ in range(56)] for _ in range(40)]


def boxes(random):
    """Blocks in the open."""
    rows = [["."] * 90 for _ in range(64)]
    for _ in range(22):
        left, top, width, height = random.below(80), random.below(56), 2 + random.below(14), 2 + random.below(9)
        for row in rows[top:top + height]:
            row[left:left + width] = "@" * len(row[left:left + width])
    return rows


def rooms(random):
    """Rooms of 9 by 9 cells, four in five of their walls with a door of 1 to 4 cells."""
    rows = [["@" if row % 10 == 0 or column % 10 == 0 else "." for column in range(61)] for row in range(51)]
    for row in range(0, 50, 10):
        for column in range(0, 60, 10):
            for down in (False, True):
                first, width, shut = 1 + random.below(5), 1 + random.below(4), random.below(5) == 0
                for i in range(first, first + width):
                    if shut:
                        continue
                    if down and column > 0:
                        rows[row + i][column] = "."
                    elif not down and row > 0:
                        rows[row][column + i] = "."
    return rows


def write(folder, name, rows, random):
    height, width = len(rows), len(rows[0])
    with open(os.path.join(folder, name + ".map"), "w") as file:
        file.write("type octile\nheight %d\nwidth %d\nmap\n" % (height, width))
        file.writelines("".join(row) + "\n" for row in rows)
    free = [(column, row) for row in range(height) for column in range(width) if rows[row][column] == "."]
    with open(os.path.join(folder, name + ".map.scen"), "w") as file:
        file.write("version 1\n")
        for _ in range(QUERIES):
            ends = free[random.below(len(free))] + free[random.below(len(free))]
            file.write("0\t%s.map\t%d\t%d\t%d\t%d\t%d\t%d\t0\n" % ((name, width, height) + ends))


def main():
    program, folder = sys.argv[1:3]
    os.makedirs(folder, exist_ok=True)
    for seed, draw in enumerate((boxes, noise, rooms)):
        random = Random(seed)
        write(folder, draw.__name__, draw(random), random)
    answer = subprocess.run([sys.executable, os.path.join(ROOT, "scripts", "path_hashes"), "--program", program,
                             folder], stdout=subprocess.PIPE, universal_newlines=True)
    if answer.returncode != 0:
        sys.exit(1)
    if "--record" in sys.argv:
        with open(os.path.join(ROOT, EXPECTED), "w") as file:
            file.write(answer.stdout)
        return
    with open(os.path.join(ROOT, EXPECTED)) as file:
        expected = file.read()
    difference = list(difflib.unified_diff(expected.splitlines(), answer.stdout.splitlines(), EXPECTED, "found",
                                           lineterm="", n=0))
    print("\n".join(difference))
    changed = sum(line.startswith("+") and not line.startswith("+++") for line in difference)
    print("%d lines compared, %d differ" % (len(expected.splitlines()), changed))
    if difference:
        print("map planner variant queries hash: these answer other paths, or other costs, than were recorded. Where "
              "that is meant, record them anew, in the same commit:\n    python3 test/command_line/check_path_hashes.py %s "
              "%s --record" % (program, folder))
        sys.exit(1)


main()
