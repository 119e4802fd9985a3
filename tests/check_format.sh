#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Holds every tracked C++ file against .clang-format; "--fix" formats them instead.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The repository may belong to another user than the one who checks it.
mapfile -d '' -t files < <(git -c safe.directory="$PWD" ls-files -z -- '*.h' '*.cc')
if [[ ${#files[@]} -eq 0 ]]; then
  echo "format: git lists no C++ files" >&2
  exit 1
fi

if [[ ${1:-} == --fix ]]; then
  exec clang-format -i "${files[@]}"
fi

differing=()
for file in "${files[@]}"; do
  clang-format --dry-run --Werror "$file" 2>/dev/null || differing+=("$file")
done
if [[ ${#differing[@]} -gt 0 ]]; then
  echo "format: ${#differing[@]} of ${#files[@]} files differ from .clang-format: ${differing[*]}" >&2
  echo "format: tests/check_format.sh --fix mends them" >&2
  exit 1
fi
echo "format: ${#files[@]} files agree with .clang-format"
