#!/usr/bin/env bash
# Tells how much of the C++ and of the Python the tests run:
#
#   trust/coverage.sh [TESTS...]            some 20 minutes of a processor
#   WORK=FOLDER trust/coverage.sh [...]     keeps the build there, and adds to what runs of
#                                           other tests have counted; python.txt and cpp.txt
#                                           tell which lines were not run
#   RECORD=FILE trust/coverage.sh           puts the figures into a record of python -m trust
#
# Needs gcc with gcov, CMake, and an environment with the development requirements and
# coverage and gcovr (see CONTRIBUTING.md), named in PYTHON. By default all tests run but
# those that assert nothing about the code: benchmarks, and what examples and documents print.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=${PYTHON:-python3}
work=${WORK:-$(mktemp -d)}
[ -n "${WORK:-}" ] || trap 'rm -rf "$work"' EXIT
tests=("$@")
if ((${#tests[@]} == 0)); then
  tests=(tests)
  for name in benchmarks benchmark_space docs examples trust view_browser; do
    tests+=("--ignore=tests/test_$name.py")
  done
fi
if [ ! -d "$work/src" ]; then
  mkdir -p "$work"
  cp -r src cpp CMakeLists.txt "$work"
  rm -f "$work"/src/alphamesh/_kernels/_core*.so
  cmake_folder=$("$python" -m nanobind --cmake_dir)
  cmake -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="--coverage" \
    -DPython_EXECUTABLE="$(command -v "$python")" -Dnanobind_DIR="$cmake_folder" > "$work/log"
  cmake --build "$work/build" --target _core -j "$(nproc)" >> "$work/log" 2>&1 || {
    tail -n 40 "$work/log" >&2
    exit 1
  }
  cp "$work"/build/_core*.so "$work/src/alphamesh/_kernels/"
  printf '[run]\nsource = %s\ndata_file = %s\n[report]\nexclude_also =\n    %s\n    %s\n' \
    "$work/src/alphamesh" "$work/counted" "if TYPE_CHECKING:" "@overload" > "$work/coveragerc"
fi
counted() { "$python" -m coverage "$1" --rcfile="$work/coveragerc" "${@:2}"; }
export PYTHONPATH="$work/src" PYTHONDONTWRITEBYTECODE=1
counted run --append -m pytest -q -p no:cacheprovider -o timeout=0 --durations=10 "${tests[@]}" ||
  echo "some tests failed: those that measure speed or memory may, in such a build" >&2
printf '\n=== Python\n\n'
counted json -q -o "$work/python.json"
counted report --skip-covered --sort=cover --show-missing > "$work/python.txt"
sed "s|$work/src/||" "$work/python.txt" | cut -c 1-150
printf '\n=== C++\n\n'
# Threads race for the counters: a count may be off, even negative, but for what is zero.
"$python" -m gcovr --root "$work" --merge-lines --object-directory "$work/build" --filter "$work/cpp/" \
  --exclude-throw-branches --gcov-ignore-parse-errors=all --gcov-ignore-errors=all --sort uncovered-percent \
  --json-summary "$work/cpp.json" --txt "$work/cpp.txt"
cut -c 1-150 "$work/cpp.txt"
if [ -n "${RECORD:-}" ]; then
  "$python" -m trust merge "$RECORD" --coverage "$work/python.json" "$work/cpp.json"
fi
