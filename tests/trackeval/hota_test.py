"""HOTA of `evaluate --tracks` against that of the package trackeval (PyPI).

Usage: hota_test.py PROGRAM. Exit code 77: skipped, numpy, scipy or trackeval are not installed.

Edges of one sample are detections as trackeval knows them. Longer edges become as many copies of a
detection as they have samples.
"""
import json
import pathlib
import random
import subprocess
import sys
import tempfile

try:
    import numpy
    from trackeval.metrics import HOTA
except ImportError as error:
    print(f"skipped: {error}; pip install numpy scipy trackeval")
    sys.exit(77)

REACH_PX = 2.0
FIELDS = {"hota": "HOTA", "det_a": "DetA", "det_re": "DetRe", "det_pr": "DetPr", "ass_a": "AssA",
          "ass_re": "AssRe", "ass_pr": "AssPr", "loc_a": "LocA"}


class Edge:
    """A level edge of whole pixels' length, whose samples lie in the middle of each pixel."""

    def __init__(self, name, x, y, length):
        self.name, self.x, self.y, self.length = name, x, y, length

    def points(self):
        return [[self.x, self.y], [self.x + self.length, self.y]]

    def samples(self):
        return [(self.x + i + 0.5, self.y) for i in range(self.length)]

    def distance(self, point):
        beyond = max(self.x - point[0], point[0] - self.x - self.length, 0)
        return (beyond ** 2 + (point[1] - self.y) ** 2) ** 0.5


def similarity(true_edge, found_edge, i, j):
    """Of a true and a found sample."""
    x, y = found_edge.samples()[j]
    along = abs(min(max(x, true_edge.x), true_edge.x + true_edge.length)
                - true_edge.samples()[i][0])
    return max(0.0, 1 - true_edge.distance((x, y)) / REACH_PX) if along <= 1 else 0.0


def by_trackeval(truth, found, numbered):
    """`numbered`: samples of one edge are identities of their own, and meet only their own kind."""
    def keys(edges):
        return [(edge.name, i if numbered else 0) for edge in edges for i in range(edge.length)]

    def places(edges):
        return [(edge, i) for edge in edges for i in range(edge.length)]

    true_ids = sorted({key for edges in truth for key in keys(edges)})
    found_ids = sorted({key for edges in found for key in keys(edges)})
    data = {"num_gt_ids": len(true_ids), "num_tracker_ids": len(found_ids),
            "num_gt_dets": sum(len(keys(edges)) for edges in truth),
            "num_tracker_dets": sum(len(keys(edges)) for edges in found),
            "gt_ids": [], "tracker_ids": [], "similarity_scores": []}
    for true_edges, found_edges in zip(truth, found):
        data["gt_ids"].append(numpy.array([true_ids.index(k) for k in keys(true_edges)], int))
        data["tracker_ids"].append(numpy.array([found_ids.index(k) for k in keys(found_edges)], int))
        scores = [[similarity(a, b, i, j) if not numbered or i == j else 0.0
                   for b, j in places(found_edges)] for a, i in places(true_edges)]
        data["similarity_scores"].append(
            numpy.array(scores).reshape(len(scores), len(data["tracker_ids"][-1])))
    return HOTA().eval_sequence(data)


def by_program(program, truth, found):
    with tempfile.TemporaryDirectory() as directory:
        paths = [pathlib.Path(directory) / name for name in ("tracks.jsonl", "truth.jsonl")]
        lines = ([], [])
        for i, (true_edges, found_edges) in enumerate(zip(truth, found)):
            lines[0].append({"frame": i, "edges": [{"points": edge.points(), "track": edge.name}
                                                   for edge in found_edges]})
            lines[1].append({"frame": i, "stamp_ns": i, "width": 640, "height": 480,
                             "edges": [{"points": edge.points(), "id": edge.name}
                                       for edge in true_edges]})
        for path, some in zip(paths, lines):
            path.write_text("".join(json.dumps(line) + "\n" for line in some))
        command = [program, "evaluate", "--tracks", *map(str, paths), "--json", "--quiet",
                   "--least-frames", "1", "--least-contrast", "0"]
        return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["hota"]


def crowd(chance):
    """Edges of one sample, so close that several found ones are within reach of a true one."""
    truth, found = [], []
    names = list(range(6))
    for _ in range(40):
        if chance.random() < 0.1:
            a, b = chance.sample(range(6), 2)
            names[a], names[b] = names[b], names[a]
        true_edges = [Edge(k, 50 + 1.5 * k + chance.uniform(-0.5, 0.5), 40 + chance.uniform(-1, 1), 1)
                      for k in range(6) if chance.random() < 0.9]
        found_edges = [Edge(100 + names[edge.name], edge.x + chance.gauss(0, 0.3),
                            edge.y + chance.gauss(0, 0.7), 1)
                       for edge in true_edges if chance.random() < 0.85]
        found_edges += [Edge(200 + k, 45 + chance.uniform(0, 20), 38 + chance.uniform(0, 5), 1)
                        for k in range(3) if chance.random() < 0.3]
        truth.append(true_edges)
        found.append(found_edges)
    return truth, found


def apart(chance):
    """Edges of several lengths far from each other; identities swap among those of one length."""
    truth, found = [], []
    lengths = [3, 3, 3, 11, 11, 40]
    names = list(range(6))
    for _ in range(40):
        if chance.random() < 0.15:
            a, b = chance.choice([(0, 1), (1, 2), (0, 2), (3, 4)])
            names[a], names[b] = names[b], names[a]
        true_edges = [Edge(k, 50, 40 + 20 * k, lengths[k]) for k in range(6)
                      if chance.random() < 0.9]
        truth.append(true_edges)
        found.append([Edge(100 + names[edge.name], edge.x, edge.y + chance.gauss(0, 0.8), edge.length)
                      for edge in true_edges if chance.random() < 0.85])
        found[-1] += [Edge(300, 200, 40, 7)] * (chance.random() < 0.4)
    return truth, found


def main():
    worst = 0
    for seed in range(12):
        for make, numbered in ((crowd, False), (apart, True)):
            truth, found = make(random.Random(seed))
            expected = by_trackeval(truth, found, numbered)
            given = by_program(sys.argv[1], truth, found)
            assert len(given["by_alpha"]) == 19
            for ours, theirs in FIELDS.items():
                for alpha, figures in enumerate(given["by_alpha"]):
                    if figures[ours] is None:  # without pairs trackeval says 1
                        assert ours == "loc_a" and expected["HOTA_TP"][alpha] == 0
                        continue
                    apart_by = abs(figures[ours] - expected[theirs][alpha])
                    assert apart_by < 1e-6, (make.__name__, seed, alpha, ours, figures[ours],
                                             expected[theirs][alpha])
                    worst = max(worst, apart_by)
            assert abs(given["mean"]["hota"] - numpy.mean(expected["HOTA"])) < 1e-6
    print(f"24 sequences, 19 thresholds, 8 figures: at most {worst:.1e} apart")


main()
