#!/usr/bin/env bash
# Renews the pictures of the README that the program makes. Needs the built program. The line
# drawings of a real camera need its frames in ../shared (or where THERMEDGE_SHARED points), which
# are not part of the repository; without them they stay as they are.
set -euo pipefail
cd "$(dirname "$0")/.."
thermedge=build/release/thermedge
out=docs/images
frames=${THERMEDGE_SHARED:-../shared}/data/optris_pi450
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$thermedge" scale 'sim:desk?sigma=20' -o "$out/desk_frame.png"
"$thermedge" detect 'sim:desk?sigma=20' -o "$work" --write mask,overlay
cp "$work/mask/desk.png" "$out/desk_mask.png"
cp "$work/overlay/desk.png" "$out/desk_overlay.png"
"$thermedge" stages 'sim:desk?sigma=12' -o "$out/stages.png" --panel-px 300
"$thermedge" compare 'sim:desk?sigma=12' -o "$out/compare.png" --panel-px 300
"$thermedge" probe 'sim:desk?sigma=12&frames=60' -o "$out/probe.png" --panel-px 300 >/dev/null

if [ -d "$frames" ]; then
  for frame in 000000 000030; do
    "$thermedge" compare "$frames/frame$frame.png" -o "$work/pi450" --write canny,thermedge
    for detector in canny thermedge; do
      cp "$work/pi450/frame$frame/$detector.png" "$out/pi450_${frame: -2}_$detector.png"
    done
  done
  "$thermedge" track "$frames" -o "$work/tracks" --write overlay --lines-only --quiet
  for frame in 20 30 40 50; do
    cp "$work/tracks/overlay/frame0000$frame.png" "$out/pi450_tracks_$frame.png"
  done
else
  echo "$frames is missing: the line drawings of the PI450 stay as they are"
fi
