"""`grid_path study` under MPI: one rank and two find the same, and a rank that is killed is named.

The study did not end then, once in five: rank 0 waited in MPI_Finalize for the rank that was lost.

    check_mpi.py GRID_PATH MPIRUN WORK_FOLDER
"""
import csv
import glob
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """
maps: [site.map]
planners: [dijkstra, a_star]
kernels: [1, 2]
queries: {random: {count: %d, seed: 1}}
repeats: %d
"""
SIDE = 200
MAP = "type octile\nheight %d\nwidth %d\nmap\n" % (SIDE, SIDE) + ("." * SIDE + "\n") * SIDE
TIMES = {"preparation [ms]", "time [ms]", "fastest [ms]", "slowest [ms]"}
SECONDS = 150


def write(folder, name, text):
    with open(os.path.join(folder, name), "w") as out:
        out.write(text)


def environment():
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_hwloc_base_binding_policy="none")


def command(mpirun, grid_path, folder, ranks, out, *options):
    return [mpirun, *options, "-np", str(ranks), grid_path, "study", os.path.join(folder, "study.yaml"),
            "--out", os.path.join(folder, out)]


def table(folder, out):
    with open(os.path.join(folder, out, "runs.csv"), newline="") as lines:
        return [{key: value for key, value in row.items() if key not in TIMES} for row in csv.DictReader(lines)]


def same_tables(mpirun, grid_path, folder):
    write(folder, "study.yaml", STUDY % (20, 1))
    for ranks in (1, 2):
        subprocess.run(command(mpirun, grid_path, folder, ranks, "same%d" % ranks), check=True,
                       env=environment(), timeout=SECONDS, stdout=subprocess.DEVNULL)
    one, two = table(folder, "same1"), table(folder, "same2")
    return [] if one == two and len(one) == 80 else ["one rank and two ranks find different tables"]


def children_of(process):
    with open("/proc/%d/task/%d/children" % (process, process)) as children:
        return sorted(int(child) for child in children.read().split())


def lost_rank(mpirun, grid_path, folder):
    write(folder, "study.yaml", STUDY % (100, 3))
    run = subprocess.Popen(command(mpirun, grid_path, folder, 2, "lost", "--enable-recovery"),
                           env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           universal_newlines=True)
    try:
        deadline = time.monotonic() + 60
        # Both ranks are at work once the first runs are there.
        while not glob.glob(os.path.join(folder, "lost", "runs.jsonl")) or \
                os.path.getsize(os.path.join(folder, "lost", "runs.jsonl")) < 4000:
            if time.monotonic() > deadline or run.poll() is not None:
                return ["the study under MPI did not begin"]
            time.sleep(0.02)
        os.kill(children_of(run.pid)[-1], signal.SIGKILL)
        said = run.communicate(timeout=SECONDS)[0]
    finally:
        run.kill()
    complaints = []
    if "rank 1 was lost" not in said:
        complaints.append("the lost rank is not named: " + said)
    if "failed=1 " not in said or "runs=398 " not in said:
        complaints.append("the rest was not completed: " + said)
    return complaints


def main():
    grid_path, mpirun, work = sys.argv[1:]
    os.makedirs(work, exist_ok=True)
    folder = tempfile.mkdtemp(dir=work)
    try:
        write(folder, "site.map", MAP)
        complaints = same_tables(mpirun, grid_path, folder) + lost_rank(mpirun, grid_path, folder)
    finally:
        shutil.rmtree(folder)
    for complaint in complaints:
        print(complaint)
    print("study under MPI: %d complaints" % len(complaints))
    sys.exit(1 if complaints else 0)


main()
