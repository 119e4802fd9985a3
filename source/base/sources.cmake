# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(base
  SOURCES
    child_process.cc
    equal_records.cc
    exceptions.cc
    find_file.cc
    finite.cc
    hdf5.cc
    input_errors.cc
    python_tool.cc
    registry.cc
    rendezvous.cc
    rigid_body_motions.cc
    stop_request.cc
    timing.cc
    versions.cc
    work_progress.cc
  LOOPS
    least_squares.cc
)
