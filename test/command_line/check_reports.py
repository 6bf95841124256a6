"""Reports of `grid_path study` and `grid_path flights` whose files and names hold what HTML, SVG and a shell would read.

Commands in reports held names of files as they were: a study in a folder called `$(touch x)` said to run that. A control
character in a name made pictures that no reader of XML opens, and a folder whose name is not UTF-8 made no report.

    check_reports.py GRID_PATH PILOT WORK_FOLDER
"""
import glob
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

HOSTILE = "it's $(touch ran) `touch ran` \"a\" <b>&amp;\\n\n;touch ran; #%20"
FOLDER = os.fsencode(HOSTILE.replace("/", "")) + b"\xff"
NAME = HOSTILE + "\x1b[2J</script></svg>]]>"
SHOWN = NAME.replace("\x1b", "\ufffd")
MAP = "type octile\nheight 4\nwidth 6\nmap\n......\n......\n@@@@..\n@@@@..\n"
STUDY = """
title: %s
maps: [%s]
planners: [dijkstra, a_star]
kernels: [1]
queries: {pairs: [[[0, 0], [5, 3]]]}
repeats: 1
"""
FLIGHTS = """
title: %s
worlds: [field.sdf]
vehicle: vehicle.yaml
start: [0, 0, 1.5, 0]
start_shift: 0.2
yaw_shift: 0.1
route: [[6, 0, 1.5]]
fence: [0.6, 4]
time_limit: 5
flights: 1
configurations:
  - {name: %s, pilot: {program: [%s, leave]}}
"""
VEHICLE = ("vehicle_radius: 0.3\nmax_surge_speed: 2\nmax_sway_speed: 2\nmax_acceleration: 2\nresponse_time: 0.15\n"
           "odometry_drift: 0.01\nodometry_noise: 0.02\ncamera_width: 80\ncamera_height: 60\ncamera_x: 0\ncamera_z: 0\n"
           "camera_pitch: 0\n")
WORLD = ("<sdf version='1.6'><world name='field'><model name='ground'><static>1</static><link name='l'>"
         "<collision name='c'><geometry><plane><normal>0 0 1</normal><size>60 60</size></plane></geometry></collision>"
         "</link></model></world></sdf>")
VOID = {"meta", "link", "br", "input", "img"}
SECONDS = 120


class Page(html.parser.HTMLParser):
    """Texts and attributes of a page, as a browser reads them; elements must be closed as they were opened."""

    def __init__(self, text):
        super().__init__()
        self.open, self.texts, self.codes, self.attributes, self.json = [], [], [], set(), ""
        self.elements = set()
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.elements.add(tag)
        self.attributes.update(value for _, value in attrs if value)
        if tag not in VOID:
            self.open.append((tag, dict(attrs)))
            if tag == "code":
                self.codes.append("")

    def handle_startendtag(self, tag, attrs):
        self.elements.add(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1][0] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        self.texts.append(data)
        if self.open and self.open[-1][0] == "code":
            self.codes[-1] += data
        if self.open and self.open[-1][1].get("type") == "application/json":
            self.json += data


def write(folder, name, text):
    with open(os.path.join(folder, os.fsencode(name)), "w", encoding="utf-8") as out:
        out.write(text)


def read(file):
    with open(file, "rb") as data:
        return data.read().decode("utf-8")  # all that is written is UTF-8


def run(arguments):
    done = subprocess.run(arguments, capture_output=True, timeout=SECONDS, check=False)
    assert done.returncode in (0, 1), (done.returncode, done.stderr)
    return done.stdout


def words_of(command):
    """What a shell makes of it, where rosrun is a function that prints its arguments."""
    script = b"rosrun() { printf '%s\\0' \"$@\"; }\n" + os.fsencode(command)
    with tempfile.TemporaryDirectory() as empty:
        done = subprocess.run(["sh"], input=script, capture_output=True, timeout=SECONDS, check=True, cwd=empty)
        assert not done.stderr and not os.listdir(empty), (command, done.stderr, os.listdir(empty))
    return done.stdout.split(b"\0")[:-1]


def shown(name):
    """As a page of UTF-8 can say it."""
    return name.decode("utf-8", "replace").encode()


def check_command(command, *expected):
    words = words_of(command)
    assert words[:2] == [b"grid_path_planner", b"grid_path"], words
    for word in expected:
        assert shown(word) in words, (word, words)


def code_blocks(page):
    """The indented blocks of a page in Markdown, after the first indented line."""
    return re.findall(r"(?:^    .*\n)+", page, re.MULTILINE)


def check_markdown(file, *expected):
    page = os.fsencode(open(file, "rb").read().decode("utf-8", "surrogateescape"))
    block = code_blocks(page.decode("utf-8", "surrogateescape"))[0]
    words = words_of(re.sub(r"^    ", "", block, flags=re.MULTILINE))
    for word in expected:
        assert word in words, (word, words)


def study(grid_path, folder):
    write(folder, HOSTILE + ".map", MAP)
    file, out, results = (os.path.join(folder, b"study.yaml"), os.path.join(folder, b"out"), os.path.join(folder, b"p q.md"))
    write(folder, "study.yaml", STUDY % (json.dumps(NAME), json.dumps(HOSTILE + ".map")))
    run([grid_path, "study", file, "--out", out, "--results", results])
    page = Page(read(os.path.join(out, b"report.html")))
    assert SHOWN in page.texts, "the title"
    assert page.elements.isdisjoint({"b>", "touch"}) and "</svg>" not in page.elements
    assert page.codes
    for command in page.codes:
        check_command(command, file, out, results)
    plans = [path["command"] for picture in json.loads(page.json)["pictures"] for unit in picture["units"]
             for path in unit["paths"]]
    assert plans
    for command in plans:
        check_command(command, os.path.join(folder, os.fsencode(HOSTILE + ".map")))
    json.loads(read(os.path.join(out, b"study.json")))
    check_markdown(results, file, out, results)
    picture = re.search(r"!\[.*\]\((\S+)\)", open(results, encoding="utf-8", errors="replace").read()).group(1)
    assert picture == "p%20q_times.svg", picture
    root = ElementTree.parse(os.path.join(folder, b"p q_times.svg")).getroot()
    title = "Planning time, " + HOSTILE + ": compare along a line, not programs of different kinds"
    assert root.get("aria-label") == title, root.get("aria-label")
    assert [text.text for text in root if text.get("class") == "chart-title"] == [title]
    # The command is the one that goes on.
    assert b"resumed=1" in subprocess.run(
        ["sh"], input=b"rosrun() { shift 2; " + os.fsencode(grid_path) + b" \"$@\"; }\n" + os.fsencode(
            re.sub(r"^    ", "", code_blocks(open(results, encoding="utf-8", errors="surrogateescape").read())[0],
                   flags=re.MULTILINE)), capture_output=True, timeout=SECONDS, check=True).stdout


def flights(grid_path, pilot, folder):
    write(folder, "field.sdf", WORLD)
    write(folder, "vehicle.yaml", VEHICLE)
    write(folder, "flights.yaml", FLIGHTS % (json.dumps(NAME), json.dumps(NAME), json.dumps(pilot)))
    file, out = os.path.join(folder, b"flights.yaml"), os.path.join(folder, b"flown")
    run([grid_path, "flights", file, "--out", out])
    page = Page(read(os.path.join(out, b"report.html")))
    repeats = [code for code in page.codes if " --flight " in code]
    assert repeats, page.codes
    for command in page.codes:
        check_command(command, file, out)
    for command in repeats:
        assert any(word.startswith(os.fsencode(SHOWN)) for word in words_of(command)), command
    pictures = glob.glob(os.path.join(glob.escape(out), b"above_*.svg"))
    assert pictures
    for picture in pictures:
        root = ElementTree.parse(picture).getroot()
        assert SHOWN in root.get("aria-label"), root.get("aria-label")


def main(grid_path, pilot, work_folder):
    shutil.rmtree(work_folder, ignore_errors=True)
    folder = os.path.join(os.fsencode(work_folder), FOLDER)
    os.makedirs(folder)
    study(grid_path, folder)
    flights(grid_path, pilot, folder)
    print("held")


main(*sys.argv[1:])
