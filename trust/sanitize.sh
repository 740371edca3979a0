#!/usr/bin/env bash
# Runs the tests of the kernels on a core that is built with sanitizers:
#
#   trust/sanitize.sh address [TESTS...]    address and undefined-behaviour sanitizers
#   trust/sanitize.sh thread [TESTS...]     data races
#
# Needs gcc or clang with their sanitizers, CMake, and an environment with the
# development requirements (see CONTRIBUTING.md), named in PYTHON.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
kind=${1:?address or thread}
shift
python=${PYTHON:-python3}
case $kind in
  address) flags="-fsanitize=address,undefined -fno-sanitize-recover=undefined" library=asan ;;
  thread) flags="-fsanitize=thread" library=tsan ;;
  *) echo "unknown sanitizer: $kind (address or thread)" >&2; exit 2 ;;
esac
tests=("$@")
if ((${#tests[@]} == 0)); then
  # All that calls the kernels; of data races, what starts threads.
  names=(core3 delaunay2 delaunay3 find2 frame2 hull2 interrupt2 invariance2 persistence2)
  names+=(periodic persistence3 pressure queries3 regular2 regular3 restricted2 sheet3 surface3)
  names+=(tiles_core tiles_space unions)
  if [[ $kind == address ]]; then
    names+=(clip2 filtration2 filtration3d nasty_space nerve2 periodic_persistence)
    names+=(periodic_weighted polygons predicates2 queries regions restricted_paths2 tiles)
    names+=(unions_degenerate unions_weighted voronoi2)
  fi
  tests=("${names[@]/#/tests/test_}")
  tests=("${tests[@]/%/.py}")
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r src "$work/src"
cmake_folder=$("$python" -m nanobind --cmake_dir)
cmake -S . -B "$work/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS="$flags" \
  -DPython_EXECUTABLE="$(command -v "$python")" -Dnanobind_DIR="$cmake_folder" > "$work/log"
cmake --build "$work/build" --target _core -j "$(nproc)" >> "$work/log" 2>&1 || {
  tail -n 40 "$work/log" >&2
  exit 1
}
rm -f "$work"/src/alphamesh/_kernels/_core*.so
cp "$work"/build/_core*.so "$work/src/alphamesh/_kernels/"
# Python itself is not built with them: its leaks are not ours, and the library comes first.
preload=$("${CXX:-c++}" -print-file-name=lib$library.so)
# The C++ library goes along, so that exceptions are seen.
preload+=":$("${CXX:-c++}" -print-file-name=libstdc++.so)"
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:history_size=4
export PYTHONPATH="$work/src" PYTHONDONTWRITEBYTECODE=1
# Neither the time of an interrupt nor a limit of memory can be held under a sanitizer.
LD_PRELOAD="$preload" "$python" -m pytest -p no:cacheprovider -o timeout=0 \
  -k "not within_a_second and not random_moments and not too_little_memory" "${tests[@]}"
