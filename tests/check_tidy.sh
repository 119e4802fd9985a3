#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Holds the library against the checks of .clang-tidy, in groups of sources as PERIDEAL_UNITY makes them (a third of
# the time); the folder given takes their list.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=${1:?usage: check_tidy.sh FOLDER}
# Debug, where no source has flags of its own that would keep it alone; GCC's precompiled header is none for clang.
cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DPERIDEAL_UNITY=ON -DBUILD_TESTING=OFF \
  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
mapfile -t sources < <(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$folder/compile_commands.json")
printf '%s\0' "${sources[@]}" |
  xargs -0 --max-args 1 --max-procs "$(env -u OMP_NUM_THREADS nproc)" clang-tidy --quiet -p "$folder" \
    --extra-arg=-Wno-unknown-warning-option 2>&1 | { grep -v ' warnings\{0,1\} generated\.$' || true; }
echo "tidy: ${#sources[@]} groups of sources agree with .clang-tidy"
