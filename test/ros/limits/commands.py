"""All that `grid_path` writes to files.

    rows = Commands(folder, out).rows    # {row: command(variant)}: what variant 0 and 1 write differs

`folder` holds what they read, `out` is written to. Rows fresh_x begin a folder of that name; the others write over what they
wrote before.
"""
import os

MAPS = ("...\n.@.\n...\n", "..@\n...\n@..\n")
WAYPOINTS = "frame_id: map\nwaypoints:\n  - {x: 0.5, y: 0.5, yaw: 0}\n  - {x: %d, y: 0.5, yaw: 0}\n"
STUDY = "maps: [0.map]\nplanners: [dijkstra]\nqueries: {pairs: [[[0, 0], [2, 2]]]}\nkernels: [1]\nrepeats: 1\n"
SCENARIO = "version 1\n0\t0.map\t3\t3\t0\t0\t2\t0\t2\n0\t0.map\t3\t3\t0\t0\t0\t2\t2\n"
FLIGHTS = """title: Short
worlds: [%(root)s/test/data/pool.sdf]
vehicle: %(root)s/config/multirotor.yaml
command_rate: 20
start: [0.0, 0.0, 1.5, 0.0]
route: [[1, 0, 1.5]]
fence: [0.1, 4.0]
time_limit: 1
rules: [safe]
flights: 1
configurations:
  - {name: a, pilot: {}}
"""
TRIAL = """title: Short
world: %(root)s/worlds/panel_site.sdf
layout: %(root)s/config/panel_markers.yaml
panel: [4.05, -0.55, 2.9, 0.42]
drive: {seconds: 12, arc: 0.8, range: [1.7, 3.3]}
seeds: 2
settle: 2
fault: [4, 8]
camera: {rate: 0.5, width: 320, height: 240}
sensors: {imu_enabled: true, dvl_enabled: true, pressure_enabled: true, usbl_enabled: true}
error_sets:
  - name: nominal
"""
DEPTH = 16  # levels of an octree


def octree(leaf):
    """A file of one leaf: each level's first child has children, but for the last."""
    head = "# Octomap OcTree binary file\nid OcTree\nsize %d\nres 0.5\ndata\n" % (DEPTH + 1)
    return head.encode() + bytes([3, 0]) * (DEPTH - 1) + bytes([leaf, 0])


class Commands:
    def __init__(self, root, folder, out):
        self.folder, self.out = folder, out
        for variant in (0, 1):
            self.write("%d.map" % variant, "type octile\nheight 3\nwidth 3\nmap\n" + MAPS[variant])
            self.write("%d.yaml" % variant, WAYPOINTS % (variant + 2))
            with open(self.given("%d.bt" % variant), "wb") as file:
                file.write(octree(1 + variant))
        self.write("study.yaml", STUDY)
        self.write("queries.scen", SCENARIO)
        self.write("flights.yaml", FLIGHTS % {"root": root})
        self.write("trial.yaml", TRIAL % {"root": root})
        self.write("recorded.yaml", "title: Dive\nbag: dive.bag\nsettle: 2\n")
        self.rows = {name[len("row_"):]: getattr(self, name) for name in dir(self) if name.startswith("row_")}

    def write(self, name, text):
        with open(self.given(name), "w") as file:
            file.write(text)

    def given(self, name):
        return os.path.join(self.folder, name)

    def to(self, name):
        return os.path.join(self.out, name)

    def plan(self, variant, *more):
        return ["plan", "--map", self.given("0.map"), "--cells", "--start", "0,0", "--goal", ("2,2", "2,0")[variant], *more]

    def row_plan_image(self, variant):
        return self.plan(variant, "--image", self.to("plan.png"))

    def row_plan_waypoints(self, variant):
        return self.plan(variant, "--waypoints", self.to("plan.yaml"))

    def row_scenarios(self, variant):
        return ["scenarios", "--scen", self.given("queries.scen"), "--limit", str(variant + 1), "--csv", self.to("costs.csv")]

    def of_map(self, variant, *words):
        return [words[0], "--map", self.given("%d.map" % variant), *words[1:]]

    def row_rectangles_file(self, variant):
        return self.of_map(variant, "rectangles", "--output", self.to("cut.rect"))

    def row_rectangles_image(self, variant):
        return self.of_map(variant, "rectangles", "--image", self.to("cut.png"))

    def row_convert_yaml(self, variant):
        return self.of_map(variant, "convert", "--output", self.to("site.yaml"))

    def row_convert_map(self, variant):
        return self.of_map(variant, "convert", "--output", self.to("site.map"))

    def row_convert_png(self, variant):
        return self.of_map(variant, "convert", "--output", self.to("site.png"))

    def row_convert_pgm(self, variant):
        return self.of_map(variant, "convert", "--output", self.to("site.pgm"))

    def waypoints(self, variant, name):
        return ["waypoints", "--input", self.given("%d.yaml" % variant), "--output", self.to(name)]

    def row_waypoints_yaml(self, variant):
        return self.waypoints(variant, "other.yaml")

    def row_waypoints_csv(self, variant):
        return self.waypoints(variant, "other.csv")

    def project(self, variant, *more):
        return ["project", "--octree", self.given("%d.bt" % variant), "--min-z", "-40000", "--max-z", "40000",
                "--bounds", "-16384,-16384,-16380,-16380", "--map", self.to("tree.yaml"), *more]

    def row_project(self, variant):
        return self.project(variant)

    def row_project_image(self, variant):
        return self.project(variant, "--image", self.to("tree.png"))

    def row_replay(self, variant):
        return ["replay", self.given("plan%d.bag" % variant), "--out", self.to("replay")]

    def job(self, command, file, row, variant):
        return [command, self.given(file), "--out", self.to(row), "--commit", "c%d" % variant,
                "--results", self.to(row + ".md")]

    def row_study(self, variant):
        return self.job("study", "study.yaml", "study", variant)

    def row_flights(self, variant):
        return self.job("flights", "flights.yaml", "flights", variant)

    def row_localization(self, variant):
        return self.job("localization", "trial.yaml", "localization", variant)

    def row_recorded(self, variant):
        return self.job("localization", "recorded.yaml", "recorded", variant)

    def row_fresh_study(self, variant):
        return self.job("study", "study.yaml", "fresh_study", variant)

    def row_fresh_flights(self, variant):
        return self.job("flights", "flights.yaml", "fresh_flights", variant)

    def row_fresh_localization(self, variant):
        return self.job("localization", "trial.yaml", "fresh_localization", variant)

    def row_fresh_recorded(self, variant):
        return self.job("localization", "recorded.yaml", "fresh_recorded", variant)

    def row_fresh_flight(self, _):
        return ["flights", self.given("flights.yaml"), "--out", self.to("fresh_flight"), "--flight", "a/1"]
