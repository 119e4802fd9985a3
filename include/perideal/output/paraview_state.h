// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_paraview_state_h
#define perideal_output_paraview_state_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <string>

namespace perideal
{
  struct VtuPiece;

  /// How ParaView shows the files that a solution.pvd lists.
  struct ParaViewState
  {
    unsigned int dimension = 2;
    /// Field of the colours: damage where there is one, else the first scalar of cells, else the
    /// displacement.
    std::string field;
    bool        of_cells = true;
    /// Whether its values lie between 0 and 1.
    bool is_share = false;
    /// Factor on the displacements, 1, 2 or 5 times a power of ten; zero without displacements.
    double magnification = 0;
    /// Corners of the body's box [m].
    dealii::Point<3> lower, upper;
  };

  /// Returns what shows a body best whose parts the ranks hold: the displacements are magnified to 6 % of the
  /// body's diagonal unless they are beyond 2 % of it anyway. Collective.
  ParaViewState choose_state(const VtuPiece &part, MPI_Comm communicator);

  /**
   * Returns the text of a state file (.pvsm) that opens solution.pvd, warps it by the displacement, colours
   * it and looks at it, in ParaView 5.9 or later. The file is named without a directory: ParaView finds it
   * where it was started, or beside the state file by "Search files under specified directory" of its dialog.
   */
  std::string state_text(const ParaViewState &state);
} // namespace perideal

#endif
