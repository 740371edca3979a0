#!/usr/bin/env bash
# Tells how much of the C++ and of the Python the tests run:
#
#   trust/coverage.sh [TESTS...]
#
# Needs gcc with gcov, CMake, and an environment with the development requirements and
# coverage and gcovr (see CONTRIBUTING.md), named in PYTHON.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
python=${PYTHON:-python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r src "$work/src"
cmake_folder=$("$python" -m nanobind --cmake_dir)
cmake -S . -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="--coverage -O1" \
  -DPython_EXECUTABLE="$(command -v "$python")" -Dnanobind_DIR="$cmake_folder" > "$work/log"
cmake --build "$work/build" --target _core -j "$(nproc)" >> "$work/log" 2>&1 || {
  tail -n 40 "$work/log" >&2
  exit 1
}
rm -f "$work"/src/alphamesh/_kernels/_core*.so
cp "$work"/build/_core*.so "$work/src/alphamesh/_kernels/"
export PYTHONPATH="$work/src" PYTHONDONTWRITEBYTECODE=1 COVERAGE_FILE="$work/coverage"
"$python" -m coverage run --source="$work/src/alphamesh" -m pytest -q -p no:cacheprovider \
  -o timeout=0 "$@" || echo "some tests failed: slow ones may, in such a build" >&2
printf '\n=== Python\n\n'
"$python" -m coverage report --skip-covered --sort=cover | tail -n 40
printf '\n=== C++\n\n'
"$python" -m gcovr --root "$root" --object-directory "$work/build" --filter "$root/cpp/" \
  --exclude-throw-branches --sort uncovered-percent
