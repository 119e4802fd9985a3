#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
set -euo pipefail

# Debian packages: to build and run; to test.
packages=(g++ cmake ninja-build libdeal.ii-dev libeigen3-dev nlohmann-json3-dev openmpi-bin gmsh)
test_packages=(libgtest-dev python3 python3-vtk9 python3-matplotlib python3-numpy git clang-format clang-tidy gmsh-doc doxygen)

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$root/build

usage()
{
  cat <<'HELP'
usage: ./perideal.sh COMMAND

  run FILE.prm [ARGUMENTS]  build the program and run a scene with it
  build                     build the program, build/perideal
  test [CTEST ARGUMENTS]    build everything and run every test
  install-packages          install what is missing of the Debian packages needed, those for tests too
  help                      print this text

The first three install missing packages first. Sources are compiled in groups, which is fastest from scratch; who
edits them had better configure the folder build with -DPERIDEAL_UNITY=OFF first. On several cores, after a build:
  mpirun -np 2 build/perideal FILE.prm
HELP
}

say()
{
  printf 'perideal.sh: %s\n' "$*" >&2
}

# Prints the packages that are not installed, one a line.
missing_packages()
{
  local package
  for package in "${packages[@]}"; do
    if [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
      printf '%s\n' "$package"
    fi
  done
}

install_packages()
{
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "no apt here, so nothing is installed; needed are the equivalents of: ${packages[*]}"
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages)
  if [[ ${#missing[@]} -eq 0 ]]; then
    return
  fi
  if [[ $EUID -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      say "as root, please: apt-get install --no-install-recommends ${missing[*]}"
      exit 1
    fi
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  "${as_root[@]}" apt-get update >&2
  "${as_root[@]}" apt-get install --yes --no-install-recommends "${missing[@]}" >&2
}

# Compilers run side by side: all cores, as far as memory reaches (2 GB each).
n_jobs()
{
  local cores by_memory
  cores=$(env -u OMP_NUM_THREADS nproc) # which else would be what OpenMP may take
  by_memory=$(awk '/^MemAvailable:/ { print int($2 / 2000000) }' /proc/meminfo 2>/dev/null || true)
  if [[ -n $by_memory && $by_memory -lt $cores ]]; then
    cores=$((by_memory > 0 ? by_memory : 1))
  fi
  printf '%s\n' "$cores"
}

# Builds a target, its build configured with the further options given where it is not yet; all that is printed
# goes to stderr, stdout belongs to the program.
build_target()
{
  local target=$1
  shift
  install_packages
  if [[ ! -f $build/build.ninja ]]; then
    cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPERIDEAL_NATIVE=ON -DPERIDEAL_UNITY=ON \
      -DBUILD_TESTING=OFF "$@" >&2
  elif [[ $# -gt 0 ]]; then
    cmake "$@" "$build" >&2
  fi
  cmake --build "$build" --target "$target" --parallel "$(n_jobs)" >&2
}

case ${1:-help} in
  run)
    if [[ $# -lt 2 ]]; then
      usage >&2
      exit 1
    fi
    shift
    build_target perideal
    export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
    exec "$build/perideal" "$@"
    ;;
  build)
    build_target perideal
    ;;
  test)
    shift
    packages+=("${test_packages[@]}")
    build_target all -DBUILD_TESTING=ON
    ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(env -u OMP_NUM_THREADS nproc)" "$@"
    ;;
  install-packages)
    packages+=("${test_packages[@]}")
    install_packages
    ;;
  help | --help | -h)
    usage
    ;;
  *)
    say "unknown command: $1"
    usage >&2
    exit 1
    ;;
esac
