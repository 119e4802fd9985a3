// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/correspondence_tangent.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "dense_matrix.h"

#include <cmath>
#include <iostream>
#include <memory>

// Eigenvalues of the free body of the correspondence model by the family's gradient (VNOSB fig. 2), with and
// without the penalty (21)-(23), by the radius of the horizon.

using namespace perideal;

namespace
{
  constexpr unsigned int n_points = 24;
  /// Share of the largest eigenvalue below which one is round-off.
  constexpr double round_off = 1e-12;

  /// Eigenvalues in ascending order.
  dealii::Vector<double> spectrum(const test::Body<2> &body, const double stabilisation)
  {
    const ElasticSolid<2> solid(ElasticConstants{1., 0.33, PlaneAssumption::plane_stress});
    const auto            rows = std::make_shared<CorrespondenceRows<2>>(
      body.families,
      nullptr,
      nullptr,
      Correspondence<2>(InfluenceFunction(Correspondence<2>::published_influence), stabilisation),
      [solid](const dealii::types::material_id) { return solid; });
    const LawsByMaterial<2>        laws = {{0, create_law<2>("linear elastic", solid)}};
    const CorrespondenceTangent<2> tangent(body.families, rows, laws);
    return test::spectrum(tangent);
  }

  void print_row(const double horizon_factor, const double stabilisation)
  {
    const auto          mesh = test::make_box<2>({n_points, n_points}, {1., 1.}, 0.);
    const test::Body<2> body(*mesh, horizon_factor);
    const auto          values  = spectrum(body, stabilisation);
    const double        largest = values[values.size() - 1];
    unsigned int        n_zero  = 0;
    while (n_zero < values.size() && values[n_zero] < round_off * largest)
      ++n_zero;
    std::cout << "| " << horizon_factor << " | " << stabilisation << " | " << n_zero << " | "
              << values[3] / largest << " |" << std::endl;
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << "| horizon over spacing | alpha over E | zero modes | fourth over largest eigenvalue |\n"
            << "|--:|--:|--:|--:|\n";
  std::cout.precision(4);
  for (const double horizon_factor : {1.5, 2.015, 3.015})
    for (const double stabilisation : {0., Correspondence<2>::published_stabilisation})
      print_row(horizon_factor, stabilisation);
}
