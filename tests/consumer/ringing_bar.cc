// SPDX-License-Identifier: LGPL-2.1-or-later
// A free bar that rings: a mesh, a material and a loop of one's own on perideal's families and bonds.
#include <perideal/neighbourhood/families.h>
#include <perideal/operators/linear/bond_operator.h>

#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <iostream>

using namespace perideal;
constexpr double pi = dealii::numbers::PI, young = 70e9, density = 2700, length = 1;

/// Springs c/r of plane stress, c = 9 E/(pi t d^3), t = 1: force c s on a bond of stretch s, half of it from
/// each end.
struct Springs : LinearModel<2>
{
  FamilyShape shape() const override { return {}; }
  bool        is_symmetric() const override { return true; }
  void        compute(const FamilyView<2> &family, FamilyCoefficients &coefficients) override
  {
    const double c = 9 * young / (pi * std::pow(family.horizon, 3));
    for (LocalIndex j = 0; j < family.size; ++j)
      coefficients.stiffness[j] =
        c / 2 * family.node_volume * family.volume[j] / std::pow(family.length_square[j], 1.5);
  }
};

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Mesh<2>                                        mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_rectangle(
    mesh.triangulation, {100u, 10u}, {}, dealii::Point<2>(length, length / 10));
  const Nodes<2> nodes(mesh, NodeParameters());
  Springs        springs;
  const auto     bonds =
    create_bond_operator<2>(std::make_shared<const Families<2>>(nodes), springs, [](const auto) {
      return ElasticSolid<2>(ElasticConstants{young, 1. / 3, PlaneAssumption::plane_stress});
    });

  NodalVector displacement, velocity, force, mode;
  for (NodalVector *vector : {&displacement, &velocity, &force, &mode})
    bonds->initialize(*vector);
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    mode.local_element(2 * i) = std::cos(pi * nodes.position[i][0] / length);
  velocity = mode; // of 1 m/s at the ends: the first longitudinal mode

  const double step = 2e-7;
  double       time = 0;
  for (; velocity * mode > 0; time += step)
    {
      displacement.add(step, velocity);
      bonds->vmult(force, displacement);
      for (LocalIndex k = 0; k < force.locally_owned_size(); ++k)
        velocity.local_element(k) -= step * force.local_element(k) / (density * nodes.volume[k / 2]);
    }
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "period " << 4e6 * time << " microseconds, of a thin bar "
              << 2e6 * length / std::sqrt(young / density) << std::endl;
}
