#!/usr/bin/env bash
# Renews the pictures of the README from the simulator. Needs the built program.
set -euo pipefail
cd "$(dirname "$0")/.."
thermedge=build/release/thermedge
out=docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$thermedge" scale 'sim:desk?sigma=20' -o "$out/desk_frame.png"
"$thermedge" detect 'sim:desk?sigma=20' -o "$work" --write mask,overlay
cp "$work/mask/desk.png" "$out/desk_mask.png"
cp "$work/overlay/desk.png" "$out/desk_overlay.png"
"$thermedge" stages 'sim:desk?sigma=12' -o "$out/stages.png" --panel-px 300
"$thermedge" compare 'sim:desk?sigma=12' -o "$out/compare.png" --panel-px 300
"$thermedge" probe 'sim:desk?sigma=12&frames=60' -o "$out/probe.png" --panel-px 300 >/dev/null
