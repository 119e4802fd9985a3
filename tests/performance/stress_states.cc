// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/quadrature/bonds_through_plane.h>

#include <deal.II/base/mpi.h>

#include "stress_lattice.h"

#include <chrono>
#include <iomanip>
#include <iostream>
#include <vector>

// Areal force densities at a node of an infinite bond-based body (QUAD 2.5.2, Figures 2.12 and 2.13): errors
// of sigma_33 in the triaxial and sigma_13 in the shear state against the number of integration points.

using namespace perideal;
using test::InfiniteBody;

namespace
{
  using Tensor = dealii::Tensor<2, 3>;

  double seconds_now()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// Average distance of the integration points in the half sphere (2.56).
  double average_distance(const double n_points)
  {
    return std::cbrt(2. * dealii::numbers::PI / 3. * std::pow(InfiniteBody::horizon, 3) / n_points);
  }

  template <typename Stress>
  void
  print_row(const std::string &name, const std::size_t n_points, const double begin, const Stress &stress)
  {
    const double triaxial       = stress(InfiniteBody::triaxial())[2][2],
                 shear          = stress(InfiniteBody::shear())[0][2];
    const double milliseconds   = 1e3 * (seconds_now() - begin) / 2;
    const auto   print_relative = [](const double value, const double exact) {
      std::cout << " | " << std::setprecision(6) << value << " | " << std::setprecision(2)
                << 100. * std::abs(value / exact - 1.);
    };
    std::cout << "| " << name << " | " << n_points << " | " << std::setprecision(3)
              << average_distance(n_points);
    print_relative(triaxial, InfiniteBody::exact(InfiniteBody::triaxial())[2][2]);
    print_relative(shear, InfiniteBody::exact(InfiniteBody::shear())[0][2]);
    std::cout << " | " << std::setprecision(3) << milliseconds << " |" << std::endl;
  }

  /// Nodes on and beyond the plane within the horizon of each node of the line, of all of them together.
  std::size_t n_points_of_lattice(const int m)
  {
    std::size_t result = 0;
    for (int i = -m; i <= m; ++i)
      for (int j = -m; j <= m; ++j)
        for (int k = 0; i * i + j * j + k * k <= m * m; ++k)
          result += k + 1;
    return result;
  }

  void print_cubic_cells(const int m)
  {
    const double              begin = seconds_now();
    const test::StressLattice lattice(m);
    print_row("cubic cell, d/" + std::to_string(m), n_points_of_lattice(m), begin, [&](const auto &strain) {
      return lattice.stress(strain);
    });
  }

  void print_line(const BondsThroughPlane<3>::Orders &orders)
  {
    const auto force = BondBased<3>(1.).pair_force(
      InfiniteBody::solid(), InfiniteBody::horizon, LinearModel<3>::Kinematics::finite);
    const double begin  = seconds_now();
    const auto   stress = [&](const dealii::SymmetricTensor<2, 3> &strain) {
      Tensor result;
      for (int axis = 0; axis < 3; ++axis)
        {
          for (const auto &fan : BondsThroughPlane<3>::find(dealii::Point<3>(),
                                                            dealii::Point<3>::unit_vector(axis),
                                                            InfiniteBody::horizon,
                                                            BodyRays<3>(),
                                                            orders))
            for (std::size_t b = 0; b < fan.bond.size(); ++b)
              {
                const auto f = fan.weight[b] * force(fan.bond[b], strain * fan.bond[b]);
                for (int d = 0; d < 3; ++d)
                  result[d][axis] += f[d];
              }
        }
      return result;
    };
    print_row("line, " + std::to_string(orders.polar) + " x " + std::to_string(orders.azimuth) +
                " directions, " + std::to_string(orders.line) + " x " + std::to_string(orders.radial),
              orders.polar * orders.azimuth * orders.line * orders.radial,
              begin,
              stress);
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << "| rule | points | ADIP | sigma_33 | error % | sigma_13 | error % | ms |\n"
            << "|---|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const int m : {3, 4, 6, 8, 12, 16, 20, 25, 33, 49, 63})
    print_cubic_cells(m);
  for (const BondsThroughPlane<3>::Orders &orders : std::vector<BondsThroughPlane<3>::Orders>{
         {1, 4, 1, 1}, {2, 6, 2, 2}, {3, 8, 3, 2}, {4, 10, 3, 3}, {6, 12, 3, 3}})
    print_line(orders);
}
