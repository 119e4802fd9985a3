# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(output
  SOURCES
    boundary_curve.cc
    checkpoint.cc
    checkpoint_file.cc
    errors.cc
    field_output.cc
    field_sink.cc
    files.cc
    history.cc
    lasting_state.cc
    paraview_state.cc
    pictures.cc
    profiles.cc
    progress.cc
    summary.cc
    vtu_text.cc
)
