#!/usr/bin/python3
"""Makes one sheet a frame: the frame, Canny after a Gaussian, preset robust, preset fast.

usage: contact_sheets.py OUT FRAME...

Needs the built program, python3-numpy and python3-opencv. FRAME is a file or sim:NAME, as `thermedge detect` takes it.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import cv2
import numpy as np

PROGRAM = pathlib.Path(__file__).resolve().parent.parent / "build/release/thermedge"
LEAST_WIDTH = 800  # of a panel, px; frames are enlarged by a whole number
TITLE_PX = 24
GAP_PX = 8
TAILS = (0.5, 99.5)  # percentiles of the counts that are black and white


def thermedge(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], check=True)


def read(path):
    picture = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    return picture if picture.ndim == 2 else cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)


def detect(frame, preset, work):
    thermedge("detect", frame, "--preset", preset, "-o", work / f"{preset}.png")
    return 255 - read(work / f"{preset}.png")


def canny(frame, work):
    """The 8-bit view of Algorithm 1, the paper's Gaussian, the thresholds of MATLAB's edge."""
    thermedge("compare", frame, "-o", work / "compare", "--denoise", "gaussian", "--write", "canny")
    (path,) = [path for path in work.glob("compare/**/*.png") if "canny" in str(path.relative_to(work))]
    return 255 - read(path)


def panels(frame, work):
    thermedge("denoise", frame, "--method", "none", "-o", work / "counts.png")
    counts = read(work / "counts.png").astype(float)
    low, high = np.percentile(counts, TAILS)
    return {
        "frame": (255 * np.clip((counts - low) / max(high - low, 1), 0, 1)).astype(np.uint8),
        "Canny after a Gaussian": canny(frame, work),
        "robust": detect(frame, "robust", work),
        "fast": detect(frame, "fast", work),
    }


def draw(pictures, name, path):
    rows = []
    for left, right in (("frame", "Canny after a Gaussian"), ("robust", "fast")):
        row = [titled(pictures[title], f"{title} {name}" if title == "frame" else title) for title in (left, right)]
        rows.append(cv2.hconcat(row))
    cv2.imwrite(str(path), cv2.vconcat(rows))


def titled(picture, title):
    factor = -(-LEAST_WIDTH // picture.shape[1])
    large = cv2.resize(picture, None, fx=factor, fy=factor, interpolation=cv2.INTER_NEAREST)
    panel = cv2.copyMakeBorder(large, TITLE_PX, GAP_PX, GAP_PX, GAP_PX, cv2.BORDER_CONSTANT, value=224)
    cv2.putText(panel, title, (GAP_PX, TITLE_PX - 7), cv2.FONT_HERSHEY_SIMPLEX, 0.55, 0, 1, cv2.LINE_AA)
    return panel


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM}: not there; run make build first")
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for frame in sys.argv[2:]:
        path = pathlib.Path(frame)
        name = re.sub(r"[^\w.=&-]+", "_", f"{path.parent.name}_{path.stem}" if path.exists() else frame).strip("_")
        with tempfile.TemporaryDirectory() as work:
            try:
                draw(panels(frame, pathlib.Path(work)), name, out / f"{name}.png")
            except subprocess.CalledProcessError:
                sys.exit(f"{frame}: no sheet")
        print(out / f"{name}.png")


if __name__ == "__main__":
    main()
