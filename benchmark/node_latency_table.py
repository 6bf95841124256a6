"""The table that node_latency prints, and the file that keeps its rows while it is measured in pieces."""
import json
import os

HEAD = ("case", "map", "subject", "rounds", "median ms", "p95", "max", "CPU ms a round", "resident MB", "remark")
KEY = 3     # the first of them, which say what was measured
ROUNDS = HEAD.index("rounds")


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def row(case, world, subject, result, cpu_s, resident_mb):
    times = result.times
    figures = ["%.3g" % (1e3 * value) for value in (percentile(times, 0.5), percentile(times, 0.95), max(times))]
    return [case, world, subject, str(len(times))] + figures + [
        "%.3g" % (1e3 * cpu_s / len(times)), "%.0f" % resident_mb, result.remark]


def missed_row(case, world, subject, reason):
    return [case, world, subject, "0", "", "", "", "", "", "missed: " + reason]


class Results:
    """Rows, those of a file first if there is one; it takes each new one at once, with the load before it and the
    versions. All are printed as they come."""

    def __init__(self, file_name, versions):
        self.file_name, self.versions, self.entries = file_name, versions, []
        print("| " + " | ".join(HEAD) + " |\n|" + "---|" * len(HEAD), flush=True)
        if file_name and os.path.exists(file_name):
            with open(file_name, encoding="utf-8") as file:
                for line in file:
                    self.keep(json.loads(line))
        self.load = os.getloadavg()[0]

    def keep(self, entry):
        self.entries.append(entry)
        print("| " + " | ".join(entry["row"]) + " |", flush=True)

    def has(self, *key):
        return any(tuple(entry["row"][:KEY]) == key for entry in self.entries)

    def add(self, cells):
        entry = {"row": cells, "load": self.load, "versions": self.versions}
        if self.file_name:
            with open(self.file_name, "a", encoding="utf-8") as file:
                file.write(json.dumps(entry) + "\n")
        self.keep(entry)
        self.load = os.getloadavg()[0]

    def missed(self):
        return [entry for entry in self.entries if entry["row"][ROUNDS] == "0"]

    def print_summary(self):
        loads = [entry["load"] for entry in self.entries] or [self.load]
        versions = sorted({entry["versions"] for entry in self.entries})
        print("\nLoad before the rows: %.1f to %.1f on %d processors. Versions: %s." % (
            min(loads), max(loads), os.cpu_count(), "; ".join(versions)))
