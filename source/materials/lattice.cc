// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/lattice.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  using dealii::SymmetricTensor;

  namespace
  {
    template <int dim>
    SymmetricTensor<2, dim> tensor_of(const FamilyCoefficients &coefficients, const LocalIndex j)
    {
      SymmetricTensor<2, dim> result;
      for (unsigned int p = 0; p < result.n_independent_components; ++p)
        result.access_raw_entry(p) = coefficients.tensor[p][j];
      return result;
    }

    /// The bonds of one family on the lattice, both halves.
    template <int dim>
    FamilyCoefficients weigh(LinearModel<dim> &model, const ElasticSolid<dim> &solid, FamilyView<dim> &family)
    {
      AssertThrow(model.shape().bond_tensors, dealii::ExcInternalError());
      family.set_solid(solid);
      FamilyCoefficients result;
      result.resize(family.size, model.shape());
      model.compute(family, result);
      for (auto &component : result.tensor)
        for (double &entry : component)
          entry *= 2.;
      return result;
    }

    /// Smallest and largest eigenvalue.
    template <int dim>
    std::pair<double, double> range(const SymmetricTensor<2, dim> &tensor)
    {
      const auto values = dealii::eigenvalues(tensor);
      return {values[dim - 1], values[0]};
    }
  } // namespace

  template <int dim>
  FamilyView<dim> lattice_family(const double horizon_factor)
  {
    FamilyView<dim> family;
    family.horizon     = horizon_factor;
    family.node_volume = 1.;
    const int reach = static_cast<int>(horizon_factor), across = dim == 3 ? reach : 0;
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -across; z <= across; ++z)
          {
            const double square = x * x + y * y + z * z;
            if (square == 0 || square > horizon_factor * horizon_factor * (1. + 1e-12))
              continue;
            const int at[3] = {x, y, z};
            for (int d = 0; d < dim; ++d)
              family.bond[d].push_back(at[d]);
            family.member.push_back(family.size++);
            family.length_square.push_back(square);
            family.volume.push_back(1.);
            family.bond_horizon.push_back(horizon_factor);
          }
    return family;
  }

  template <int dim>
  double smallest_wave_stiffness(LinearModel<dim>        &model,
                                 const ElasticSolid<dim> &solid,
                                 const double             horizon_factor)
  {
    FamilyView<dim>          family = lattice_family<dim>(horizon_factor);
    const FamilyCoefficients bonds  = weigh(model, solid, family);

    // Wave vectors of the lattice's first zone, on a half of it: k and -k are one wave.
    const int n      = dim == 2 ? 30 : 8;
    double    result = std::numeric_limits<double>::max();
    for (int x = 0; x <= n; ++x)
      for (int y = -n; y <= n; ++y)
        for (int z = dim == 3 ? -n : 0; z <= (dim == 3 ? n : 0); ++z)
          {
            const int              at[3] = {x, y, z};
            dealii::Tensor<1, dim> k;
            for (int d = 0; d < dim; ++d)
              k[d] = dealii::numbers::PI * at[d] / n;
            if (k.norm() == 0)
              continue;
            SymmetricTensor<2, dim> stiffness, acoustic;
            for (LocalIndex j = 0; j < family.size; ++j)
              {
                double phase = 0;
                for (int d = 0; d < dim; ++d)
                  phase += k[d] * family.bond[d][j];
                stiffness += (1. - std::cos(phase)) * tensor_of<dim>(bonds, j);
              }
            for (int a = 0; a < dim; ++a)
              for (int b = a; b < dim; ++b)
                for (int p = 0; p < dim; ++p)
                  for (int q = 0; q < dim; ++q)
                    acoustic[a][b] += solid.stiffness()[a][p][b][q] * k[p] * k[q];
            result = std::min(result, range(stiffness).first / range(acoustic).first);
          }
    return result;
  }

  template <int dim>
  double smallest_bond_stiffness(LinearModel<dim>        &model,
                                 const ElasticSolid<dim> &solid,
                                 const double             horizon_factor)
  {
    FamilyView<dim>          family = lattice_family<dim>(horizon_factor);
    const FamilyCoefficients bonds  = weigh(model, solid, family);
    double                   result = 1.;
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        const auto eigenvalues = range(tensor_of<dim>(bonds, j));
        result                 = std::min(result, eigenvalues.first / eigenvalues.second);
      }
    return result;
  }

  template <int dim>
  double lattice_anisotropy(const double horizon_factor)
  {
    const FamilyView<dim> family = lattice_family<dim>(horizon_factor);
    double                axial = 0, oblique = 0;
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        const double x = family.bond[0][j], y = family.bond[1][j];
        const double cube = std::pow(family.length_square[j], 1.5);
        axial += x * x * x * x / cube;
        oblique += x * x * y * y / cube;
      }
    return axial / (3. * oblique) - 1.;
  }

  PERIDEAL_INSTANTIATE(lattice_family)
  PERIDEAL_INSTANTIATE(smallest_wave_stiffness)
  PERIDEAL_INSTANTIATE(smallest_bond_stiffness)
  PERIDEAL_INSTANTIATE(lattice_anisotropy)

} // namespace perideal
