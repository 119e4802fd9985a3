// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_stress_lattice_h
#define perideal_tests_unit_stress_lattice_h

#include <perideal/materials/bond_based.h>
#include <perideal/operators/post/partial_stress.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <memory>

/// QUAD 2.5.2: the stress of a uniform strain at a node of an infinite bond-based body, E = 1e5, d = 18.
namespace perideal::test
{
  struct InfiniteBody
  {
    static constexpr double young = 1e5, horizon = 18.;

    /// The strain that linear elasticity gives to a stress, Poisson's ratio 1/4.
    static dealii::SymmetricTensor<2, 3> strain_of(const dealii::SymmetricTensor<2, 3> &stress)
    {
      return (1.25 * stress - 0.25 * trace(stress) * dealii::unit_symmetric_tensor<3>()) / young;
    }

    static dealii::SymmetricTensor<2, 3> uniaxial()
    {
      dealii::SymmetricTensor<2, 3> stress;
      stress[1][1] = 100.;
      return strain_of(stress);
    }
    static dealii::SymmetricTensor<2, 3> triaxial()
    {
      dealii::SymmetricTensor<2, 3> stress;
      stress[0][0] = 100.;
      stress[1][1] = -150.;
      stress[2][2] = 220.;
      return strain_of(stress);
    }
    static dealii::SymmetricTensor<2, 3> shear()
    {
      dealii::SymmetricTensor<2, 3> stress;
      stress[0][2] = 200.;
      return strain_of(stress);
    }

    static ElasticSolid<3> solid(const double modulus = young)
    {
      return ElasticSolid<3>(ElasticConstants{modulus, 0.25, PlaneAssumption::solid});
    }

    /// The exact areal force densities along the axes, as columns: of each direction mu in the half sphere of
    /// the normal n, (mu.n) c s d^4/4 along the deformed direction, which does not depend on the length.
    static dealii::Tensor<2, 3> exact(const dealii::SymmetricTensor<2, 3> &strain)
    {
      using dealii::numbers::PI;
      const double            c = 18. * young / (3. * (1. - 2. * 0.25)) / (PI * std::pow(horizon, 4));
      const dealii::QGauss<1> cosines(40);
      constexpr unsigned int  n_azimuth = 80;
      dealii::Tensor<2, 3>    result;
      for (int axis = 0; axis < 3; ++axis)
        for (unsigned int q = 0; q < cosines.size(); ++q)
          for (unsigned int a = 0; a < n_azimuth; ++a)
            {
              const double         cosine = cosines.point(q)[0], sine = std::sqrt(1. - cosine * cosine);
              dealii::Tensor<1, 3> direction;
              direction[axis]              = cosine;
              direction[(axis + 1) % 3]    = sine * std::cos(2. * PI * a / n_azimuth);
              direction[(axis + 2) % 3]    = sine * std::sin(2. * PI * a / n_azimuth);
              const dealii::Tensor<1, 3> y = direction + strain * direction;
              const dealii::Tensor<1, 3> f = c * (1. - 1. / y.norm()) * y;
              for (int d = 0; d < 3; ++d)
                result[d][axis] +=
                  cosines.weight(q) * 2. * PI / n_azimuth * cosine * std::pow(horizon, 4) / 4. * f[d];
            }
      return result;
    }
  };

  /// A node and those of a cubic lattice within its horizon, spacing d/m, that count the parts of their cells
  /// of QUAD (2.16). Only the first node has a family; the others have no horizon to speak of, so that
  /// their halves of the bonds' forces are missing, which a doubled modulus makes up for.
  class StressLattice
  {
  public:
    explicit StressLattice(const int m)
    {
      const double spacing = InfiniteBody::horizon / m;
      add({0, 0, 0}, spacing, InfiniteBody::horizon);
      for (int i = -m; i <= m; ++i)
        for (int j = -m; j <= m; ++j)
          for (int k = -m; k <= m; ++k)
            if (const int square = i * i + j * j + k * k; square > 0 && square <= m * m)
              add({i * spacing, j * spacing, k * spacing}, spacing, 1e-6 * spacing);
      nodes.communicator = MPI_COMM_SELF;
      nodes.number();
      QuadratureParameters quadrature;
      quadrature.scheme = QuadratureScheme::cubic_cell;
      families          = std::make_shared<const Families<3>>(nodes, create_volume_rule<3>(quadrature));
      BondBased<3> model(1.);
      // No bond is cut, but families may be empty.
      force = create_bond_force<3>(*weigh_bonds<3>(
        families,
        model,
        [](const dealii::types::material_id) { return InfiniteBody::solid(2. * InfiniteBody::young); },
        {[](const dealii::Point<3> &, const dealii::Point<3> &) { return false; }}));
    }

    /// Of the first node [Pa].
    dealii::Tensor<2, 3> stress(const dealii::SymmetricTensor<2, 3> &strain) const
    {
      NodalVector displacement, unused;
      force->initialize(displacement);
      force->initialize(unused);
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        for (int d = 0; d < 3; ++d)
          displacement.local_element(3 * i + d) = (strain * nodes.position[i])[d];
      force->compute(unused, displacement);
      return partial_stress<3>(*families, *force)[0];
    }

  private:
    void add(const dealii::Point<3> &position, const double spacing, const double horizon)
    {
      nodes.position.push_back(position);
      nodes.volume.push_back(spacing * spacing * spacing);
      nodes.spacing.push_back(spacing);
      nodes.horizon.push_back(horizon);
      nodes.material.push_back(0);
    }

    NodeCloud<3>                       nodes;
    std::shared_ptr<const Families<3>> families;
    std::unique_ptr<BondForce<3>>      force;
  };
} // namespace perideal::test

#endif
