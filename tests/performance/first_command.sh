#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Times a user's first command on a bare Debian 12: a new system in a folder, the files of this commit, and
#   ./perideal.sh run prm/examples/plate_with_hole.prm
# As root, with debootstrap (apt-get install debootstrap):
#   tests/performance/first_command.sh FOLDER [MIRROR]
# FOLDER must not exist; it takes 5 GB and stays, with everything that was printed in first_command.log.
set -euo pipefail

folder=${1:?usage: first_command.sh FOLDER [MIRROR]}
mirror=${2:-http://deb.debian.org/debian}
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [[ -e $folder ]]; then
  echo "first_command.sh: $folder exists" >&2
  exit 1
fi

debootstrap --variant=minbase bookworm "$folder" "$mirror"
cp /etc/resolv.conf "$folder/etc/resolv.conf"
mkdir "$folder/root/perideal"
git -C "$checkout" -c safe.directory="$checkout" archive HEAD | tar -x -C "$folder/root/perideal"

# How much memory there is, from which the number of compilers follows, stands in /proc.
mounted=()
trap 'for point in "${mounted[@]}"; do umount "$point"; done' EXIT
for system in proc sys; do
  if mount -t "${system/sys/sysfs}" none "$folder/$system" 2>/dev/null; then
    mounted+=("$folder/$system")
  else
    echo "first_command.sh: goes on without /$system, which cannot be mounted here" >&2
  fi
done

milliseconds()
{
  printf '%s\n' "${EPOCHREALTIME/./}" | sed 's/...$//'
}

# Names the phases after the first line that each prints.
status=0
start=$(milliseconds)
phase=packages phase_start=$start
end_phase()
{
  local now
  now=$(milliseconds)
  printf '%-14s %8.1f s\n' "$phase" "$(((now - phase_start)))e-3"
  phase=$1 phase_start=$now
}
report=$folder/first_command.txt
{
  while IFS= read -r line; do
    printf '%s\n' "$line"
    case $phase:$line in
      packages:"-- "*) end_phase configuration >>"$report" ;;
      configuration:"-- Build files"*) end_phase compilation >>"$report" ;;
      compilation:*"Linking CXX executable"*) end_phase "link and run" >>"$report" ;;
    esac
  done
  end_phase end >>"$report"
} < <(env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root OMPI_ALLOW_RUN_AS_ROOT=1 \
      OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 chroot "$folder" /root/perideal/perideal.sh run \
      /root/perideal/prm/examples/plate_with_hole.prm --set "Output directory=/root/output" 2>&1 ||
      echo "exit status $?") >"$folder/first_command.log"
if tail -n 1 "$folder/first_command.log" | grep '^exit status' >&2; then
  status=1
fi
phase=total phase_start=$start
end_phase end >>"$report"
cat "$report"
exit "$status"
