// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_treatment_list_h
#define perideal_parameters_treatment_list_h

/*
 * The treatments of boundary conditions, an entry each: its name in C++, its name in parameter files, and
 * what the help says of it. This is all that names a treatment outside its file of the room treatments, which
 * defines hold_by_NAME() or load_by_NAME(), and outside of rules about what goes with what.
 */

/// Of prescribed displacements.
#define PERIDEAL_DISPLACEMENT_TREATMENTS(TREATMENT)                                                          \
  TREATMENT(face_value,                                                                                      \
            "face value",                                                                                    \
            "in the place of interpolated values at the boundary's faces (consistent form only)")            \
  TREATMENT(layer, "layer", "nodes of the cells at the boundary take the boundary's value")                  \
  TREATMENT(reference, "reference", "they take the reference solution's value at the node (for studies)")    \
  TREATMENT(mirror, "mirror", "a fictitious layer of mirrored nodes behind a plane boundary")                \
  TREATMENT(surface_nodes,                                                                                   \
            "surface nodes",                                                                                 \
            "a node of its own in the middle of each face, with the volume of its cell once more")           \
  TREATMENT(taylor_ghosts,                                                                                   \
            "taylor ghosts",                                                                                 \
            "the far ends of bonds that are missing behind the surface move by Taylor polynomials that "     \
            "meet the boundary's values (with the same treatment of tractions)")

/// Of tractions and pressures.
#define PERIDEAL_TRACTION_TREATMENTS(TREATMENT)                                                              \
  TREATMENT(layer, "layer", "as forces on the nodes of the cells at the boundary")                           \
  TREATMENT(taylor_ghosts,                                                                                   \
            "taylor ghosts",                                                                                 \
            "by bonds that are missing behind the surface, also where it is free, whose far ends move by "   \
            "Taylor polynomials that meet the tractions (statics, not the consistent form, with the same "   \
            "treatment of displacements)")                                                                   \
  TREATMENT(                                                                                                 \
    transfer, "transfer", "spread over the nodes within a horizon, with force and moment of each face")      \
  TREATMENT(published_transfer, "published transfer", "as published, 1.386 times too large")                 \
  TREATMENT(line_to_point,                                                                                   \
            "line to point",                                                                                 \
            "the closed form of bond-based peridynamics in 3-D for tractions along the normal")              \
  TREATMENT(                                                                                                 \
    published_line_to_point, "published line to point", "as published, with a third of the force lost")      \
  TREATMENT(face_value, "face value", "at the faces of the consistent form")

#endif
