# The front door. Every target installs what it needs first (Debian 12, root or sudo).
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c

# Pictures for `make bench`, see docs/benchmarks.md; optional.
PHOTOGRAPHS ?= ../shared/data/denoise
# Random scenes for `make bench`; more of them give steadier figures and take longer.
BENCH_SCENES ?= 8

.PHONY: help configure build build-all demo quick test check bench clean

help:
	@echo "make build   the program at build/release/thermedge"
	@echo "make demo    edges of simulated frames, pictures under demo/"
	@echo "make quick   the tests that take little time"
	@echo "make test    all tests"
	@echo "make check   format, static analysis, tests built with Clang and under sanitizers"
	@echo "make bench   speed and quality on this machine, beside OpenCV where it is installed (BENCH_SCENES=24: longer)"
	@echo "make clean   remove what was built"

configure:
	@scripts/install_packages.sh build
	@cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
	@rm -f build-configure.log
	@echo "== building (the first time takes some minutes)"

build: configure
	@cmake --build --preset release --target thermedge_cli
	@echo "The program: build/release/thermedge --help"

build-all: configure
	@cmake --build --preset release

demo: build
	@scripts/demo.sh

quick: build-all
	@ctest --preset release -L quick -j "$$(nproc)"

test: build-all
	@echo "== testing"
	@ctest --preset release -j "$$(nproc)"
	@echo "Details: build/release/Testing/Temporary/LastTest.log"

check: build-all
	@scripts/install_packages.sh check
	@scripts/check.sh

bench: build
	@scripts/install_packages.sh bench
	@cmake --preset release -DTHERMEDGE_BUILD_BENCH=ON >/dev/null
	@cmake --build --preset release --target stages_bench denoise_bench edges_bench
	@build/release/bench/stages_bench
	@build/release/bench/edges_bench docs/benchmarks --scenes "$(BENCH_SCENES)"
	@build/release/bench/denoise_bench docs/benchmarks/denoise.csv "$(PHOTOGRAPHS)"
	@/usr/bin/python3 scripts/plot_edges.py docs/benchmarks
	@/usr/bin/python3 scripts/plot_denoise.py docs/benchmarks/denoise.csv
	@echo "Tables and plots: docs/benchmarks.md"

clean:
	rm -rf build demo
