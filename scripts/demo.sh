#!/usr/bin/env bash
# The main job on simulated frames: pictures under demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

thermedge=build/release/thermedge
out=demo
for scene in desk corridor; do
  for sigma in 6 20; do
    spec="sim:$scene?sigma=$sigma"
    dir="$out/${scene}_sigma$sigma"
    mkdir -p "$dir"
    echo "== $spec"
    "$thermedge" scale "$spec" -o "$dir/frame.png"
    "$thermedge" detect "$spec" -o "$dir" --write mask,overlay,json,svg
    "$thermedge" detect "$spec"
  done
done
echo "== a recording with its true edges"
"$thermedge" simulate office -o "$out/office" --path drive --frames 20
echo "== sheets"
"$thermedge" stages 'sim:desk?sigma=20' -o "$out/stages.png"
"$thermedge" compare 'sim:desk?sigma=20' -o "$out/compare.png"
"$thermedge" probe 'sim:desk?sigma=20&frames=30' -o "$out/probe.png"
echo
echo "Look at"
echo "  $out/stages.png    every step from the frame to its edges"
echo "  $out/compare.png   the classical detectors and thermedge on one frame"
echo "  $out/probe.png     what the recording is like"
echo "  $out/office        a simulated recording: counts, depth, true edges, trajectory"
echo "and, for each of $out/desk_sigma6, desk_sigma20, corridor_sigma6, corridor_sigma20:"
echo "  frame.png        the noisy frame, 8 bits at a constant number of degrees per grey level (Algorithm 1)"
echo "  mask/*.png       the edges as a binary picture"
echo "  overlay/*.png    the edges over the frame, best in yellow, last in violet"
echo "  json/*.json, svg/*.svg   the same for programs and as vectors"
