# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(mesh
  SOURCES
    abaqus_deck.cc
    abaqus_lines.cc
    abaqus_to_gmsh.cc
    adaptation.cc
    create_mesh.cc
    generators.cc
    gmsh_elements.cc
    gmsh_inner_faces.cc
    gmsh_lines.cc
    gmsh_scan.cc
    local_refinement.cc
    manifolds.cc
    mesh.cc
    mesh_checks.cc
    mesh_file.cc
    mesh_joints.cc
    mesh_parameters.cc
    parent_mesh.cc
    plate_with_hole.cc
    plate_with_hole_grid.cc
    point_location.cc
    read_gmsh.cc
    run_gmsh.cc
)
