#!/usr/bin/env bash
# Renews the golden maps. Needs the built program, octave and octave-image.
set -euo pipefail
cd "$(dirname "$0")"
thermedge=${1:-../../../build/release/thermedge}
for scene in desk corridor; do
  for sigma in 6 20; do
    "$thermedge" scale "sim:$scene?width=192&height=144&sigma=$sigma" -o "${scene}_$sigma.pgm"
  done
done
octave --quiet make_golden.m
rm -f ./*.pgm
