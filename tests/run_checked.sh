#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Builds the lowest floors of the library a second time, in the folder given, and runs their tests: with deal.II's and
# the standard library's assertions, under the address and undefined-behaviour sanitizers, and without the
# instructions that not every x86-64 processor has.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=${1:?usage: run_checked.sh FOLDER}
jobs=$(env -u OMP_NUM_THREADS nproc)

cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DPERIDEAL_NATIVE=OFF -DPERIDEAL_SANITIZE=ON \
  -DPERIDEAL_UNITY=ON -DBUILD_TESTING=ON
cmake --build "$folder" --parallel "$jobs" --target unit_lowest_floors

# Leaks are not looked for: what Open MPI keeps to the end lies in modules that are unloaded by then, and has no
# names that could be suppressed.
export ASAN_OPTIONS=detect_leaks=0
export UBSAN_OPTIONS=print_stacktrace=1
ctest --test-dir "$folder" --output-on-failure --no-tests=error --tests-regex '^unit\.lowest_floors\.'
