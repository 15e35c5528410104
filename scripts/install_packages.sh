#!/usr/bin/env bash
# Installs what is missing of the Debian packages that a step needs.
# usage: install_packages.sh build|check|bench ...
set -euo pipefail

declare -A packages=(
  [build]="g++ make cmake ninja-build libhwy-dev libtbb-dev libexpected-dev libspng-dev libtiff-dev
           nlohmann-json3-dev libtomlplusplus-dev libcli11-dev libfmt-dev libgtest-dev libeigen3-dev
           pkg-config libcairo2-dev libfontconfig-dev fonts-open-sans libzip-dev
           libmatio-dev python3 python3-jsonschema"
  [check]="clang-14 clang-format-14 clang-tidy libclang-rt-14-dev llvm-14 libbenchmark-dev"
  [bench]="libbenchmark-dev python3-matplotlib"
)

missing=()
for group in "$@"; do
  for package in ${packages[$group]}; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done
done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "== installing: ${missing[*]}"
if ! command -v apt-get >/dev/null; then
  echo "apt-get is not here; please install these packages by hand" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "not root and no sudo; please install these packages as root" >&2
    exit 1
  }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
