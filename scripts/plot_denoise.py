#!/usr/bin/env python3
"""Draws what denoise_bench measured and puts its table into docs/benchmarks.md.

usage: plot_denoise.py docs/benchmarks/denoise.csv
"""
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from benchmark_page import COLOURS, read, replace_between

SIZE = ("382", "288")
# Shapes tell the methods apart in grey.
SHAPES = {"BM3D": "o", "NL-means": "s", "Gaussian": "^"}
# Reference implementation of IPOL on the photographs, mean over sigma 10, 25, 50.
BM3D_REFERENCE_DB = (33.190 + 28.541 + 25.720) / 3


def psnr(row, pictures):
    values = [float(value) for key, value in row.items() if key.startswith(f"psnr_{pictures}_")]
    return sum(values) / len(values) if values else None


def picture_sets(rows):
    names = [re.match(r"psnr_(\w+)_\d+", key) for key in rows[0]]
    return list(dict.fromkeys(name[1] for name in names if name))


def best_simd(rows):
    return next(row["simd"] for row in rows if row["simd"])


def draw(rows, pictures, path):
    shown = [
        row
        for row in rows
        if (row["width"], row["height"]) == SIZE
        and row["threads"] == "1"
        and row["simd"] in ("", best_simd(rows))
    ]
    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    axes.axvline(8.8, color="0.7", linewidth=1, linestyle="--")
    axes.text(9.2, axes.get_ylim()[0], "80 Hz at 382x288", color="0.4", rotation=90, va="bottom",
              transform=axes.get_xaxis_transform(), fontsize=8)
    if pictures == "photographs":
        axes.axhline(BM3D_REFERENCE_DB, color="0.7", linewidth=1)
        axes.text(0.99, BM3D_REFERENCE_DB, "BM3D, reference implementation (IPOL)", color="0.4",
                  ha="right", va="bottom", transform=axes.get_yaxis_transform(), fontsize=8)
    for row in shown:
        speed, quality = float(row["mpx_per_s"]), psnr(row, pictures)
        colour = COLOURS[row["library"]]
        axes.scatter(speed, quality, color=colour, marker=SHAPES[row["method"]], s=45)
        left = row["library"] == "OpenCV" or row["settings"] in ("quality", "balanced")
        axes.annotate(f"{row['method']} {row['settings']}", (speed, quality),
                      xytext=(-6 if left else 6, 0), textcoords="offset points",
                      ha="right" if left else "left", va="center", fontsize=7.5, color=colour)
    for library, colour in COLOURS.items():
        if any(row["library"] == library for row in shown):
            axes.scatter([], [], color=colour, label=library)
    axes.legend(loc="lower left")
    axes.set_xscale("log")
    axes.margins(x=0.16, y=0.1)
    axes.set_xlabel("million pixels a second on one thread (382x288)")
    axes.set_ylabel("PSNR, dB: mean over noise of sigma 10, 25, 50 grey levels")
    axes.set_title(f"Denoisers: quality over speed, {pictures}")
    axes.grid(alpha=0.25)
    figure.savefig(path, dpi=110)


def table(rows):
    sets = picture_sets(rows)
    lines = [
        "| | SIMD | 382x288, 1 thread | 2 threads | 640x512, 1 thread | 2 threads | "
        + " | ".join(f"PSNR, {name}" for name in sets)
        + " |",
        "|---|---|" + "---:|" * (4 + len(sets)),
    ]
    keys = dict.fromkeys(
        (row["library"], row["method"], row["settings"], row["simd"]) for row in rows
    )
    for key in keys:
        found = [row for row in rows if (row["library"], row["method"], row["settings"],
                                         row["simd"]) == key]
        speeds = {(row["width"], row["threads"]): f"{float(row['mpx_per_s']):.3g}" for row in found}
        cells = [speeds[(width, threads)] for width in ("382", "640") for threads in ("1", "2")]
        cells += [
            " / ".join(
                f"{float(value):.2f}"
                for column, value in found[0].items()
                if column.startswith(f"psnr_{name}_")
            )
            for name in sets
        ]
        lines.append(f"| {' '.join(key[:3])} | {key[3]} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    source = pathlib.Path(sys.argv[1])
    rows = read(source)
    for pictures in picture_sets(rows):
        draw(rows, pictures, source.with_name(f"denoise_{pictures}.png"))
    replace_between(source.parent.parent / "benchmarks.md", "denoise table", table(rows))


if __name__ == "__main__":
    main()
