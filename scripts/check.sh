#!/usr/bin/env bash
# Format, static analysis, and the tests under AddressSanitizer + UBSan, built with a second compiler
# and its warnings as errors, and under ThreadSanitizer.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "== format"
git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 --dry-run --Werror

# Highway compiles a kernel once for each instruction set; the analysis sees one of them.
echo "== static analysis"
cmake --preset release >/dev/null
git ls-files 'src/*.cpp' 'sim/*.cpp' 'figures/*.cpp' 'eval/*.cpp' 'cli/*.cpp' |
  xargs -P "$(nproc)" -n 2 clang-tidy --quiet -p build/release --warnings-as-errors='*' \
    --extra-arg=-DHWY_COMPILE_ONLY_STATIC 2>/dev/null

export UBSAN_OPTIONS=print_stacktrace=1
export ASAN_SYMBOLIZER_PATH=/usr/lib/llvm-14/bin/llvm-symbolizer
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan_suppressions.txt:print_suppressions=0"
export TSAN_OPTIONS="suppressions=$PWD/scripts/tsan_suppressions.txt"
for preset in asan tsan; do
  echo "== tests under $preset"
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset"
  ctest --preset "$preset" -j "$(nproc)" --quiet || {
    ctest --preset "$preset" --rerun-failed --output-on-failure
    exit 1
  }
done
echo "== all checks passed"
