#!/usr/bin/env bash
# Tells how much of the C++ and of the Python the tests run:
#
#   trust/coverage.sh [TESTS...]          some 20 minutes of a processor
#   KEEP=FOLDER trust/coverage.sh         what is not run, line by line, in FOLDER
#   RECORD=FILE trust/coverage.sh         adds the figures to a record of python -m trust
#
# Needs gcc with gcov, CMake, and an environment with the development requirements and
# coverage and gcovr (see CONTRIBUTING.md), named in PYTHON. By default all tests run but
# those that assert nothing about the code: benchmarks, and what examples and documents print.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
python=${PYTHON:-python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tests=("$@")
if ((${#tests[@]} == 0)); then
  tests=(tests)
  for name in benchmarks benchmark_space docs examples trust view_browser; do
    tests+=("--ignore=tests/test_$name.py")
  done
fi
cp -r src "$work/src"
cmake_folder=$("$python" -m nanobind --cmake_dir)
cmake -S . -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="--coverage" \
  -DPython_EXECUTABLE="$(command -v "$python")" -Dnanobind_DIR="$cmake_folder" > "$work/log"
cmake --build "$work/build" --target _core -j "$(nproc)" >> "$work/log" 2>&1 || {
  tail -n 40 "$work/log" >&2
  exit 1
}
rm -f "$work"/src/alphamesh/_kernels/_core*.so
cp "$work"/build/_core*.so "$work/src/alphamesh/_kernels/"
# Subprocesses count, too: most of the command line runs in them.
printf '[run]\nsource = %s\ndata_file = %s\nparallel = true\npatch = subprocess\n' \
  "$work/src/alphamesh" "$work/coverage" > "$work/coveragerc"
printf '[report]\nexclude_also =\n    if TYPE_CHECKING:\n' >> "$work/coveragerc"
export PYTHONPATH="$work/src" PYTHONDONTWRITEBYTECODE=1
"$python" -m coverage run --rcfile="$work/coveragerc" -m pytest -q -p no:cacheprovider \
  -o timeout=0 --durations=15 "${tests[@]}" ||
  echo "some tests failed: those that measure speed or memory may, in such a build" >&2
"$python" -m coverage combine --rcfile="$work/coveragerc" > /dev/null
report() { "$python" -m coverage "$@" --rcfile="$work/coveragerc"; }
printf '\n=== Python\n\n'
report json -q -o "$work/python.json"
report report --skip-covered --sort=cover --show-missing | sed "s|$work/||" | tee "$work/python.txt" |
  cut -c 1-150
printf '\n=== C++\n\n'
# Threads race for the counters, so that a count may be off, even negative; not what is zero.
"$python" -m gcovr --root "$root" --object-directory "$work/build" --filter "$root/cpp/" \
  --exclude-throw-branches --gcov-ignore-parse-errors=all --sort uncovered-percent \
  --json-summary "$work/cpp.json" --txt "$work/cpp.txt"
cut -c 1-150 "$work/cpp.txt"
if [ -n "${RECORD:-}" ]; then
  "$python" -m trust merge "$RECORD" --coverage "$work/python.json" "$work/cpp.json"
fi
if [ -n "${KEEP:-}" ]; then
  mkdir -p "$KEEP"
  cp "$work"/{python,cpp}.{json,txt} "$KEEP/"
fi
