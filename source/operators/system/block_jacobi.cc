// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/block_jacobi.h>

#include <cmath>
#include <sstream>

namespace perideal
{
  template <int dim>
  BlockJacobi<dim>::BlockJacobi(const ConstrainedOperator<dim> &system)
    : inverse(system.jacobi_blocks())
  {
    for (LocalIndex i = 0; i < inverse.size(); ++i)
      {
        const double size = inverse[i].norm();
        if (!(std::abs(determinant(inverse[i])) > 1e-12 * std::pow(size, dim)))
          {
            std::ostringstream message;
            message << "the stiffness of the node at (" << system.mirror_layer().nodes().position[i]
                    << ") m is singular: its family does not span the space\n  advice: enlarge "
                       "Nodes/Horizon factor or refine the mesh there";
            throw ComputationError(message.str());
          }
        inverse[i] = invert(inverse[i]);
      }
  }

  template <int dim>
  void BlockJacobi<dim>::vmult(NodalVector &destination, const NodalVector &source) const
  {
    const double *from = source.begin();
    double       *to   = destination.begin();
    for (LocalIndex i = 0; i < inverse.size(); ++i, from += dim, to += dim)
      for (int d = 0; d < dim; ++d)
        {
          double sum = 0;
          for (int e = 0; e < dim; ++e)
            sum += inverse[i][d][e] * from[e];
          to[d] = damping * sum;
        }
  }

  PERIDEAL_INSTANTIATE_CLASS(BlockJacobi)
} // namespace perideal
