// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_family_energy_h
#define perideal_materials_family_energy_h

#include <perideal/materials/linear_model.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace perideal
{
  /// Adds up what bonds of a family store (FamilyCoefficients), each with what is left of its weights.
  /// @tparam Number double, or Lanes for four states at once
  template <int dim, typename Number = double>
  class FamilyEnergy
  {
  public:
    /// What a whole bond adds: to the sums of the family and its own force weights, and twice the energy that
    /// it stores by itself.
    struct Part
    {
      std::array<double, 2> sums  = {{0., 0.}};
      double                force = 0., own = 0.;
    };

    /// The coefficients must outlive this object.
    FamilyEnergy(const FamilyCoefficients &coefficients, const FamilyShape &shape)
      : coefficients(coefficients)
      , shape(shape)
    {
    }

    void clear()
    {
      sums  = {};
      force = own = Number();
    }

    /// The part of a member's bond.
    /// @param eta by which its ends move apart @param eps eta times the bond
    Part part_of(const LocalIndex j, const double eps, const dealii::Tensor<1, dim> &eta) const
    {
      Part result;
      for (unsigned int a = 0; a < shape.n_sums; ++a)
        result.sums[a] = coefficients.sum[a][j] * eps;
      if (shape.own_force_weights)
        result.force = coefficients.force_weight[0][j] * eps;
      result.own = twice_of(j, eps, eta);
      return result;
    }

    /// Adds a share of a bond; a negative one takes it away.
    void add(const Part &part, const Number &share)
    {
      for (unsigned int a = 0; a < shape.n_sums; ++a)
        sums[a] += share * part.sums[a];
      if (shape.own_force_weights)
        force += share * part.force;
      own += share * part.own;
    }

    /// Returns twice the energy.
    Number twice() const
    {
      if (shape.own_force_weights)
        return own + 2. * sums[0] * (force + coefficients.energy * sums[0]);
      const auto &map = coefficients.map;
      return own + map[0] * sums[0] * sums[0] + 2. * map[1] * sums[0] * sums[1] + map[2] * sums[1] * sums[1];
    }

  private:
    /// Twice the energy of a bond for itself.
    double twice_of(const LocalIndex j, const double eps, const dealii::Tensor<1, dim> &eta) const
    {
      if (!shape.bond_tensors)
        return coefficients.stiffness[j] * eps * eps;
      dealii::SymmetricTensor<2, dim> tensor;
      for (unsigned int c = 0; c < tensor.n_independent_components; ++c)
        tensor.access_raw_entry(c) = coefficients.tensor[c][j];
      return eta * (tensor * eta);
    }

    const FamilyCoefficients &coefficients;
    const FamilyShape         shape;
    std::array<Number, 2>     sums  = {};
    Number                    force = Number(), own = Number();
  };
} // namespace perideal

#endif
