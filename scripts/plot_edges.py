#!/usr/bin/env python3
"""Draws what edges_bench measured and puts its tables into docs/benchmarks.md.

usage: plot_edges.py docs/benchmarks
"""
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from benchmark_page import COLOURS, read, replace_between, table

OURS = {"thermedge robust": "#0072B2", "thermedge fast": "#56B4E9", "thermedge paper": "#009E73"}
PRESETS = {name.split()[1]: colour for name, colour in OURS.items()}
CANNY = "Gaussian and Canny of OpenCV"  # in scaling.csv
PEERS = {"OpenCV Canny": "#D55E00", "OpenCV EDPF": "#CC79A7"}
MARKS = "osD^vP"
RANGE_COUNTS = 130
# A matched filter that looks 6 px to each side of an edge of L px has the noise
# 2 sigma / sqrt(12 L) on the step, and must rise above what the noise does at the best of
# 110 000 places in some 200 directions and bends.
STRIP_PX = 12
CANDIDATES = 2e7


def limit_sigmas(length_px):
    return 2 * math.sqrt(2 * math.log(CANDIDATES) / (STRIP_PX * length_px))


def style(rows):
    """Colour, line style and mark for each contender, in the order of the file."""
    looks, count = {}, {}
    for row in rows:
        name, family = row["competitor"], row["family"]
        if name in looks:
            continue
        index = count[family] = count.get(family, -1) + 1
        colour = OURS.get(name, COLOURS[family])
        dash = "-" if family == "thermedge" else "--" if family == "OpenCV" else ":"
        looks[name] = {"color": colour, "linestyle": dash, "marker": MARKS[index % len(MARKS)]}
    return looks


def spread(heights, gap):
    """Moves heights apart so that labels do not overlap."""
    order = sorted(range(len(heights)), key=lambda i: heights[i])
    placed = list(heights)
    for _ in range(200):
        for low, high in zip(order, order[1:]):
            lack = gap - (placed[high] - placed[low])
            if lack > 1e-9:
                placed[low] -= lack / 2
                placed[high] += lack / 2
    return placed


def draw_noise(rows, path):
    shown = [row for row in rows if row["set"] == "random"]
    looks = style(shown)
    figure, axes = plt.subplots(figsize=(10, 6.2), layout="constrained")
    ends = {}
    for name, look in looks.items():
        points = [(float(row["noise_counts"]), float(row["f"])) for row in shown
                  if row["competitor"] == name]
        ours = name in OURS
        axes.plot(*zip(*points), markersize=5, linewidth=2.2 if ours else 1.1,
                  zorder=3 if ours else 2, **look)
        ends[name] = points[-1]
    heights = spread([end[1] for end in ends.values()], 0.032)
    for (name, end), height in zip(ends.items(), heights):
        axes.annotate(name, end, xytext=(end[0] + 0.8, height), va="center", fontsize=8,
                      color=looks[name]["color"],
                      arrowprops={"arrowstyle": "-", "color": "0.8", "linewidth": 0.6})
    last = max(float(row["noise_counts"]) for row in shown)
    axes.set_xlim(-0.5, last * 1.27)
    axes.set_ylim(0, 1)
    axes.set_xticks([0, 5, 10, 15, 20, 25, 30])
    above = axes.secondary_xaxis("top")
    above.set_xticks([2, 4, 8, 12, 16, 20, 25, 30],
                     [f"{RANGE_COUNTS / sigma:.3g}" for sigma in (2, 4, 8, 12, 16, 20, 25, 30)])
    above.set_xlabel("range of the scene / noise", fontsize=8)
    above.tick_params(labelsize=8)
    axes.set_xlabel("noise, counts (sigma); the scenes span 130 counts")
    axes.set_ylabel("F = 2 P R / (P + R) of the edge pixels")
    axes.set_title(f"Edges over noise: {shown[0]['frames']} random scenes; thermedge with defaults, "
                   "the others tuned at each noise level", fontsize=10)
    axes.grid(alpha=0.25)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def names(rows, column):
    """The values of a column, each once, in the order of the file."""
    return list(dict.fromkeys(row[column] for row in rows))


def draw_conditions(rows, path):
    conditions = names(rows, "condition")
    figure, axes = plt.subplots(figsize=(10, 5.6), layout="constrained")
    shown = {**OURS, "Canny of counts": "#D55E00", "Canny after Gaussian": "#E69F00",
             "Edge Drawing": "#CC79A7"}
    for name in names(rows, "competitor"):
        values = {row["condition"]: float(row["f"]) for row in rows if row["competitor"] == name}
        errors = [1 - values.get(condition, math.nan) for condition in conditions]
        if name in shown:
            axes.scatter(errors, range(len(conditions)), color=shown[name], label=name, zorder=3,
                         marker="o" if name in OURS else "s", s=45 if name in OURS else 30)
        else:
            axes.scatter(errors, range(len(conditions)), color="0.8", s=16, zorder=2)
    axes.scatter([], [], color="0.8", s=16, label="the others")
    axes.set_yticks(range(len(conditions)), conditions)
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xlim(0.7, 0.01)
    shares = (0.4, 0.6, 0.8, 0.9, 0.95, 0.97, 0.98, 0.99)
    axes.set_xticks([1 - share for share in shares], [f"{share:g}" for share in shares])
    axes.minorticks_off()
    axes.set_xlabel("F of the edge pixels")
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.42, -0.09), ncols=7)
    axes.set_title(f"Conditions of users' frames: {rows[0]['frames']} random scenes each; thermedge "
                   "with defaults, the others tuned for each condition", fontsize=10)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def conditions_table(rows):
    conditions = names(rows, "condition")
    values = {(row["condition"], row["competitor"]): float(row["f"]) for row in rows}
    lines = [[name] + [f"{values[(condition, name)]:.3f}" if (condition, name) in values else ""
                       for condition in conditions] for name in names(rows, "competitor")]
    return table([""] + conditions, lines)


def draw_noise_kinds(rows, path):
    kinds = names(rows, "noise")
    figure, axes = plt.subplots(figsize=(10, 6), layout="constrained")
    marks = {"0.01": "v", "0.1": "o", "1": "^"}
    for preset in names(rows, "preset"):
        shift = -0.15 if preset == "robust" else 0.15
        for most, mark in marks.items():
            points = [(float(row["edges_per_frame"]), kinds.index(row["noise"]) + shift)
                      for row in rows
                      if (row["preset"], row["max_false_alarms"]) == (preset, most)]
            axes.scatter(*zip(*points), marker=mark, s=26, color=PRESETS[preset], zorder=3,
                         label=f"{preset}, {most} asked")
    for most in marks:
        axes.axvline(float(most), color="0.7", linewidth=1, linestyle="--")
    axes.set_xscale("symlog", linthresh=0.01)
    axes.set_xlim(-0.001, 100)
    axes.set_xticks([0, 0.01, 0.1, 1, 10, 100], ["0", "0.01", "0.1", "1", "10", "100"])
    axes.set_yticks(range(len(kinds)), kinds)
    axes.invert_yaxis()
    axes.set_xlabel("edges a frame")
    axes.set_title("Edges found in frames that hold nothing but noise of other kinds", fontsize=10)
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8, loc="upper right")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def noise_kinds_table(rows):
    values = {(row["preset"], row["noise"], row["max_false_alarms"]):
              f"{float(row['edges_per_frame']):.3g}" for row in rows}
    columns = [(preset, most) for preset in names(rows, "preset")
               for most in names(rows, "max_false_alarms")]
    lines = [[kind] + [values[(preset, kind, most)] for preset, most in columns]
             for kind in names(rows, "noise")]
    return table(["noise"] + [f"`{preset}`, {most}" for preset, most in columns], lines)


def label_heights(rows):
    """Only labels that stand beside each other give way to each other."""
    columns = {}
    for row in rows:
        columns.setdefault(sum(float(row["ms"]) > bound for bound in (1.8, 5)), []).append(row)
    heights = {}
    for column in columns.values():
        placed = spread([float(row["f"]) for row in column], 0.036)
        below = max(0, max(placed) - 0.98)
        heights.update({row["competitor"]: height - below
                        for row, height in zip(column, placed)})
    return [heights[row["competitor"]] for row in rows]


def draw_time(rows, path):
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.8), layout="constrained", sharey=True)
    looks = style([row for row in rows if row["set"] == "random"])
    for axes, noise in zip(panels, ("8", "20")):
        shown = [row for row in rows if row["set"] == "random" and row["noise_counts"] == noise]
        axes.axvline(12.5, color="0.7", linewidth=1, linestyle="--")
        axes.text(13.2, 0.02, "80 frames a second", color="0.4", rotation=90, va="bottom",
                  fontsize=8, transform=axes.get_xaxis_transform())
        for row in shown:
            look = looks[row["competitor"]]
            axes.scatter(float(row["ms"]), float(row["f"]), color=look["color"],
                         marker=look["marker"], s=40, zorder=3)
        heights = label_heights(shown)
        for row, height in zip(shown, heights):
            x = float(row["ms"])
            axes.annotate(row["competitor"], (x, float(row["f"])), xytext=(x * 1.18, height),
                          va="center", fontsize=7.5, color=looks[row["competitor"]]["color"],
                          arrowprops={"arrowstyle": "-", "color": "0.85", "linewidth": 0.6})
        axes.set_xscale("log")
        axes.set_xlim(0.3, 1200)
        axes.set_xticks([1, 10, 100], ["1", "10", "100"])
        axes.set_ylim(0, 1)
        axes.set_xlabel("ms for a frame of 382x288 on one thread")
        axes.set_title(f"noise of {noise} counts in a range of {RANGE_COUNTS}", fontsize=10)
        axes.grid(alpha=0.25)
    panels[0].set_ylabel("F of the edge pixels")
    figure.suptitle("Quality over time: up and left is better")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def shares(rows, name, setting, length):
    points = [(float(row["contrast_sigmas"]), int(row["found"]) / int(row["trials"]))
              for row in rows
              if (row["competitor"], row["setting"], row["length_px"]) == (name, setting, length)]
    return sorted(points)


def half_found(points):
    """Contrast at which half of the edges are found, None beyond the largest one tried."""
    before = (0.0, 0.0)
    for point in points:
        if point[1] >= 0.5:
            return before[0] + (0.5 - before[1]) / (point[1] - before[1]) * (point[0] - before[0])
        before = point
    return None


def best_settings(rows):
    """Of each contender, the setting that finds the most in all."""
    found = {}
    for row in rows:
        key = (row["competitor"], row["setting"])
        found[key] = found.get(key, 0) + int(row["found"])
    best = {}
    for (name, setting), count in found.items():
        if name not in best or count > found[(name, best[name])]:
            best[name] = setting
    return best


def draw_single_edges(rows, path):
    lengths = list(dict.fromkeys(row["length_px"] for row in rows))
    figure, panels = plt.subplots(1, len(lengths), figsize=(14, 4), layout="constrained",
                                  sharey=True)
    colours = {**OURS, **PEERS}
    for axes, length in zip(panels, lengths):
        axes.axvline(limit_sigmas(int(length)), color="black", linewidth=1, linestyle="--",
                     label="limit of any detector that looks\n6 px to each side of the edge")
        for name, setting in best_settings(rows).items():
            axes.plot(*zip(*shares(rows, name, setting, length)), marker="o", markersize=3,
                      color=colours[name], label=name)
        axes.set_xscale("log")
        axes.set_xticks([0.2, 0.5, 1, 2], ["0.2", "0.5", "1", "2"])
        axes.minorticks_off()
        axes.set_title(f"edges of {length} px", fontsize=10)
        axes.set_xlabel("contrast / noise")
        axes.grid(alpha=0.25)
    panels[0].set_ylabel("share of the edges that are found")
    panels[0].legend(loc="upper left", fontsize=7)
    figure.suptitle("How faint an edge may be: single edges in noise with stripes, all detectors "
                    "set to 0.1 false edges a frame", fontsize=11)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def single_edges_table(rows):
    lengths = list(dict.fromkeys(row["length_px"] for row in rows))
    lines = []
    for name, setting in best_settings(rows).items():
        halves = [half_found(shares(rows, name, setting, length)) for length in lengths]
        lines.append([f"{name}, {setting}"] + [f"{h:.2f}" if h else "> 3" for h in halves])
    lines.append(["*limit*"] + [f"{limit_sigmas(int(length)):.2f}" for length in lengths])
    return table([""] + [f"{length} px" for length in lengths], lines)



def draw_false_alarms(rows, path):
    kinds = list(dict.fromkeys(row["frame"] for row in rows))
    figure, panels = plt.subplots(1, len(kinds) + 1, figsize=(14, 3.9), layout="constrained")
    swept = [row for row in rows if row["noise_counts"] == "20"]
    for axes, kind in zip(panels, kinds):
        for preset, colour in PRESETS.items():
            points = [(float(row["noise_counts"]), float(row["edges_per_frame"])) for row in rows
                      if (row["preset"], row["frame"]) == (preset, kind) and row not in swept]
            axes.plot(*zip(*points), marker="o", markersize=4, color=colour,
                      label=f"thermedge {preset}")
        axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=0.1)
        axes.axhline(0.1, color="black", linewidth=1, label="--max-false-alarms (default)")
        axes.set_ylim(-0.02, 200)
        axes.set_xticks([1, 10, 100], ["1", "10", "100"])
        axes.set_yticks([0, 0.1, 1, 10, 100], ["0", "0.1", "1", "10", "100"])
        axes.set_xlabel("noise, counts (sigma)")
        axes.set_title(f"noise, {kind}" if kind != "plain" else "plain noise", fontsize=10)
        axes.grid(alpha=0.25)
    panels[0].set_ylabel("false edges a frame")
    axes = panels[-1]
    lines = ["-", "--", ":"]
    for preset in dict.fromkeys(row["preset"] for row in swept):
        for kind, line in zip(kinds, lines):
            points = [(float(row["max_false_alarms"]), float(row["edges_per_frame"]))
                      for row in swept if (row["preset"], row["frame"]) == (preset, kind)]
            axes.plot(*zip(*points), marker="o", markersize=3, linestyle=line,
                      color=PRESETS[preset], label=f"{preset}, {kind}")
    axes.plot([0.01, 1], [0.01, 1], color="black", linewidth=1, label="what was asked for")
    axes.set_xscale("log")
    axes.set_yscale("symlog", linthresh=0.01)
    axes.set_ylim(-0.002, 100)
    axes.set_xticks([0.01, 0.1, 1], ["0.01", "0.1", "1"])
    axes.set_yticks([0, 0.01, 0.1, 1], ["0", "0.01", "0.1", "1"])
    axes.set_xlabel("--max-false-alarms")
    axes.set_title("noise of 20 counts", fontsize=10)
    axes.grid(alpha=0.25)
    axes.legend(fontsize=6.5, loc="upper left", handlelength=3.5)
    panels[0].legend(fontsize=7.5, loc="center right")
    figure.suptitle("Edges found in frames that hold nothing")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def false_alarms_table(rows):
    kept = [row for row in rows if row["noise_counts"] != "20"]
    noises = list(dict.fromkeys(row["noise_counts"] for row in kept))
    lines = []
    for preset in PRESETS:
        for kind in dict.fromkeys(row["frame"] for row in kept):
            cells = [f"{float(row['edges_per_frame']):.3g}" for row in kept
                     if (row["preset"], row["frame"]) == (preset, kind)]
            lines.append([f"`{preset}`", kind] + cells)
    return table(["preset", "frames of noise"] + [f"sigma {noise}" for noise in noises], lines, 2)


def draw_denoisers(rows, path):
    noises = list(dict.fromkeys(row["noise_counts"] for row in rows))
    denoisers = list(dict.fromkeys(row["denoiser"] for row in rows))
    detectors = list(dict.fromkeys(row["detector"] for row in rows))
    figure, panels = plt.subplots(1, len(noises), figsize=(12, 4.8), layout="constrained",
                                  sharey=True)
    for axes, noise in zip(panels, noises):
        values = {(row["detector"], row["denoiser"]): float(row["f"]) for row in rows
                  if row["noise_counts"] == noise}
        grid = [[values.get((detector, denoiser), math.nan) for denoiser in denoisers]
                for detector in detectors]
        image = axes.imshow(grid, cmap="cividis", vmin=0, vmax=1, aspect="auto")
        for y, line in enumerate(grid):
            best = max(value for value in line if not math.isnan(value))
            for x, value in enumerate(line):
                text = "\N{EN DASH}" if math.isnan(value) else f"{value:.2f}"
                axes.text(x, y, text, ha="center", va="center", fontsize=8.5,
                          color="white" if value < 0.55 else "black",
                          weight="bold" if value == best else "normal")
        axes.set_xticks(range(len(denoisers)), denoisers, rotation=25, ha="right")
        axes.set_yticks(range(len(detectors)), detectors)
        axes.set_title(f"noise of {noise} counts in a range of {RANGE_COUNTS}", fontsize=10)
        axes.set_xlabel("denoiser in front")
    figure.colorbar(image, ax=panels, label="F of the edge pixels")
    figure.suptitle("What each denoiser does for each detector (best of each row in bold)")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def stage_names(rows):
    return [key[:-3] for key in rows[0] if key.endswith("_ms") and key != "cpu_ms"]


def presets_on_one_thread(rows):
    return [row for row in rows
            if (row["width"], row["threads"]) == ("382", "1") and row["detector"] in PRESETS]


def draw_scaling(rows, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.6), layout="constrained")
    sizes = list(dict.fromkeys((row["width"], row["height"]) for row in rows))
    for preset, colour in PRESETS.items():
        for threads, line in (("1", "-"), ("2", "--")):
            points = [(int(row["width"]) * int(row["height"]) / 1e6, float(row["ms"]))
                      for row in rows if (row["detector"], row["threads"]) == (preset, threads)]
            left.plot(*zip(*points), color=colour, linestyle=line, marker="o", markersize=4,
                      label=f"{preset}, {threads} thread{'s' if threads == '2' else ''}")
    left.axhline(12.5, color="0.7", linewidth=1)
    left.text(0.99, 12.5, "80 frames a second", transform=left.get_yaxis_transform(), ha="right",
              va="bottom", fontsize=8, color="0.4")
    left.set_xscale("log")
    left.set_yscale("log")
    ticks = [int(width) * int(height) / 1e6 for width, height in sizes]
    left.set_xticks(ticks, [f"{width}x{height}" for width, height in sizes], rotation=30,
                    ha="right", fontsize=8)
    left.minorticks_off()
    left.set_yticks([1, 3, 10, 30, 100, 300], ["1", "3", "10", "30", "100", "300"])
    left.set_ylabel("ms a frame")
    left.set_title("Time over the size of the frame", fontsize=10)
    left.grid(alpha=0.25)
    left.legend(fontsize=8)

    shown = presets_on_one_thread(rows)
    stages = stage_names(rows)
    bottom = [0.0] * len(shown)
    colours = plt.get_cmap("tab20").colors
    for stage, colour in zip(stages, colours):
        values = [float(row[f"{stage}_ms"] or 0) for row in shown]
        right.barh([row["detector"] for row in shown], values, left=bottom, color=colour, label=stage)
        bottom = [low + value for low, value in zip(bottom, values)]
    right.invert_yaxis()
    right.set_xlabel("ms a frame of 382x288 on one thread")
    right.set_title("Where the time goes", fontsize=10)
    right.legend(fontsize=8, ncols=2)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def noise_table(rows):
    shown = [row for row in rows if row["set"] == "random"]
    noises = [noise for noise in dict.fromkeys(row["noise_counts"] for row in shown)]
    lines = []
    for name in dict.fromkeys(row["competitor"] for row in shown):
        of_one = {row["noise_counts"]: row for row in shown if row["competitor"] == name}
        cells = [f"{float(of_one[noise]['f']):.3f}" for noise in noises]
        at = of_one["20"]
        lines.append([name] + cells + [f"{float(at['precision']):.2f} / {float(at['recall']):.2f}",
                                       f"{float(at['ms']):.2f}"])
    return table([""] + [f"sigma {noise}" for noise in noises]
                 + ["P / R at 20", "ms at 20"], lines)


def scenes_table(rows):
    shown = [row for row in rows if row["set"] != "random"]
    keys = list(dict.fromkeys((row["set"], row["noise_counts"]) for row in shown))
    values = {(row["set"], row["noise_counts"], row["competitor"]): row for row in shown}
    lines = [[name] + [f"{float(values[(*key, name)]['f']):.3f}" for key in keys]
             for name in dict.fromkeys(row["competitor"] for row in shown)]
    return table([""] + [f"{name}, sigma {float(noise):.0f}" for name, noise in keys], lines)


def scaling_table(rows):
    lines = []
    for preset in PRESETS:
        for threads in ("1", "2"):
            cells = [f"{float(row['ms']):.1f}" for row in rows
                     if (row["detector"], row["threads"]) == (preset, threads)]
            lines.append([f"`{preset}`, {threads}"] + cells)
    sizes = list(dict.fromkeys(f"{row['width']}x{row['height']}" for row in rows))
    return table(["preset, threads"] + sizes, lines)


def stages_table(rows):
    shown = presets_on_one_thread(rows)
    stages = stage_names(rows)
    lines = [[f"`{row['detector']}`"] + [f"{float(row[stage + '_ms']):.2f}" if row[stage + '_ms']
                                       else "" for stage in stages] for row in shown]
    return table(["preset"] + stages, lines)


def ratios_table(rows):
    """Processor time of the presets over that of Canny, and what two threads gain by the clock."""
    value = {(row["detector"], row["threads"], row["width"]): row for row in rows}
    if not any(row["detector"] == CANNY for row in rows):
        return "OpenCV was not there."
    lines = []
    for width, height in (("382", "288"), ("640", "512"), ("1920", "1080")):
        time = lambda name, threads, column: float(value[(name, threads, width)][column])
        cells = [f"{time(CANNY, '1', 'cpu_ms'):.2f}"]
        for preset in ("robust", "fast"):
            for threads in ("1", "2"):
                for column in ("cpu_ms", "ms"):
                    ratio = time(preset, threads, column) / time(CANNY, threads, column)
                    cells.append(f"{ratio:.1f}")
        lines.append([f"{width}x{height}"] + cells)
    header = [f"`{preset}`, {threads} thread{'s' if threads == '2' else ''}, {clock}"
              for preset in ("robust", "fast") for threads in ("1", "2")
              for clock in ("processor", "clock")]
    return table(["", "Gaussian + Canny, processor ms"] + header, lines)


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__.strip())
    place = pathlib.Path(sys.argv[1])
    page = place.parent / "benchmarks.md"
    rows = {name: read(place / f"{name}.csv") for name in
            ("edges", "conditions", "single_edges", "false_alarms", "noise_kinds",
             "denoisers_and_detectors", "scaling")}
    draw_noise(rows["edges"], place / "edges_over_noise.png")
    draw_time(rows["edges"], place / "edges_over_time.png")
    draw_conditions(rows["conditions"], place / "conditions.png")
    draw_noise_kinds(rows["noise_kinds"], place / "noise_kinds.png")
    draw_single_edges(rows["single_edges"], place / "single_edges.png")
    draw_false_alarms(rows["false_alarms"], place / "false_alarms.png")
    draw_denoisers(rows["denoisers_and_detectors"], place / "denoisers_and_detectors.png")
    draw_scaling(rows["scaling"], place / "scaling.png")
    replace_between(page, "noise table", noise_table(rows["edges"]))
    replace_between(page, "scenes table", scenes_table(rows["edges"]))
    replace_between(page, "conditions table", conditions_table(rows["conditions"]))
    replace_between(page, "noise kinds table", noise_kinds_table(rows["noise_kinds"]))
    replace_between(page, "ratios table", ratios_table(rows["scaling"]))
    replace_between(page, "single edges table", single_edges_table(rows["single_edges"]))
    replace_between(page, "false alarms table", false_alarms_table(rows["false_alarms"]))
    replace_between(page, "scaling table", scaling_table(rows["scaling"]))
    replace_between(page, "stages table", stages_table(rows["scaling"]))


if __name__ == "__main__":
    main()
