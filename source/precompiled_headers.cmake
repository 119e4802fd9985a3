# SPDX-License-Identifier: LGPL-2.1-or-later

# The headers that take longest to compile: 18 s once, then 4 to 5 s less a file. A source with other
# machine flags than the rest needs the property SKIP_PRECOMPILE_HEADERS.
# -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON does without, and shows includes that a file forgot.
target_precompile_headers(perideal_library PRIVATE
  <deal.II/base/mpi.h>
  <deal.II/base/parameter_handler.h>
  <deal.II/base/utilities.h>
  <deal.II/distributed/tria.h>
  <deal.II/dofs/dof_handler.h>
  <deal.II/fe/fe_system.h>
  <deal.II/fe/fe_values.h>
  <deal.II/lac/la_parallel_vector.h>
)
