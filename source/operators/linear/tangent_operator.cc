// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/family_operator.h>
#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/linear/tensor_operator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// The tangent of FamilyForce: the loops are those of FamilyOperator.
    template <int dim, unsigned int n_sums, bool own_force_weights>
    class FamilyTangent : public FamilyOperator<dim, n_sums, own_force_weights, true>
    {
    public:
      using Loops = FamilyOperator<dim, n_sums, own_force_weights, true>;

      explicit FamilyTangent(const std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> &from)
        : Loops(from)
      {
        deformation.scale.assign(weights->bonds.n_slots(), 1.);
        deformation.stiffness.resize(weights->bonds.n_slots());
        for (BondIndex slot = 0; slot < weights->bonds.n_slots(); ++slot)
          deformation.stiffness[slot] = weights->stiffness[weights->at(slot)];
        deformation.tension.assign(weights->bonds.n_slots(), 0.);
      }

      void linearise(const BondForce<dim> &force, const Slope slope) override
      {
        std::copy_n(force.positions(), positions.size(), positions.begin());
        const BondList       &bonds     = weights->bonds;
        const SofteningBonds &softening = force.softening_bonds();
        BondIndex             slot      = 0;
        bool                  goes_on   = false;
        deformation.scale_in_sums.clear();
        if (n_sums > 0 && softening.softens() && slope == Slope::tangent)
          deformation.scale_in_sums.resize(deformation.scale.size());
        force.visit_bond_forces(
          [&](const LocalIndex i, const LocalIndex j, const dealii::Tensor<1, dim> &pull) {
            while (bonds.neighbour[slot] != j || slot < bonds.row[i])
              ++slot; // padding
            set_bond(slot, i, j, pull);
            if (!deformation.scale_in_sums.empty())
              deformation.scale_in_sums[slot] = deformation.scale[slot];
            if (softening.softens())
              goes_on |= soften(slot, softening.left(slot, 1. / deformation.scale[slot] - 1.), slope);
            ++slot;
          });
        for (const auto &bond : force.lost_bonds())
          deformation.scale[bond.slot] = deformation.tension[bond.slot] = 0.;
        if (deformation.scale_in_sums.empty())
          return;
        for (const auto &bond : force.lost_bonds())
          deformation.scale_in_sums[bond.slot] = 0.;
        if (dealii::Utilities::MPI::max(goes_on ? 1u : 0u, families->communicator) == 0)
          deformation.scale_in_sums.clear();
      }

      bool is_symmetric() const override { return weights->symmetric && deformation.scale_in_sums.empty(); }

    private:
      using Loops::deformation;
      using Loops::families;
      using Loops::positions;
      using Loops::weights;

      void set_bond(const BondIndex               slot,
                    const LocalIndex              i,
                    const LocalIndex              j,
                    const dealii::Tensor<1, dim> &pull)
      {
        dealii::Tensor<1, dim> bond;
        for (int d = 0; d < dim; ++d)
          bond[d] = positions[j].value[d] - positions[i].value[d];
        const double rest = (families->position[j] - families->position[i]).norm_square(),
                     now  = bond.norm_square();
        // The force m p is g (y_j - y_i).
        const double tension        = (pull * bond) / now;
        deformation.scale[slot]     = std::sqrt(rest / now);
        deformation.tension[slot]   = tension;
        deformation.stiffness[slot] = weights->stiffness[weights->at(slot)] - tension / rest;
      }

      /// With p the share g times what it was: the sums have g p then, and what goes with p p is divided by
      /// g^2. Tells whether the bond goes on to soften.
      bool soften(const BondIndex slot, const SofteningBonds::Left &left, const Slope slope)
      {
        if (left.share == 1.)
          return false;
        const double whole     = weights->stiffness[weights->at(slot)];
        const double stretched = 1. / deformation.scale[slot];
        const double by_length = deformation.stiffness[slot] - whole; // -tension/|xi|^2
        deformation.scale[slot] *= left.share;
        if (left.share == 0.)
          {
            if (!deformation.scale_in_sums.empty())
              deformation.scale_in_sums[slot] = 0.;
            return false;
          }
        const double change = slope == Slope::secant ? 0. : left.slope;
        const double along = left.stiffness * whole + by_length - by_length * stretched / left.share * change;
        deformation.stiffness[slot] = along / (left.share * left.share);
        if (!deformation.scale_in_sums.empty())
          deformation.scale_in_sums[slot] *= left.share + change * (stretched - 1.);
        return change != 0.;
      }
    };

    /// The tangent of TensorForce, which is linear: only the lost bonds are missing.
    template <int dim>
    class TensorTangent : public TangentOperator<dim>
    {
    public:
      explicit TensorTangent(const std::shared_ptr<const TensorWeights<dim>> &weights)
        : weights(weights)
        , whole(std::make_unique<TensorOperator<dim>>(weights))
      {
        this->counts      = weights->counts;
        this->reports     = weights->reports;
        this->partitioner = weights->families->make_partitioner(dim);
      }

      void linearise(const BondForce<dim> &force, const Slope) override
      {
        const auto           &lost      = force.lost_bonds();
        const SofteningBonds &softening = force.softening_bonds();
        if (lost.size() == n_lost && !softening.softens())
          return;
        auto rest = std::make_shared<TensorWeights<dim>>(*weights);
        for (const auto &bond : lost)
          for (auto &values : rest->component)
            values[bond.slot] = 0.;
        if (softening.softens())
          scale_softened(force, *rest);
        whole  = std::make_unique<TensorOperator<dim>>(rest);
        n_lost = lost.size();
      }

      void vmult(NodalVector &force, const NodalVector &displacement) const override
      {
        whole->vmult(force, displacement);
      }
      std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override { return whole->jacobi_blocks(); }
      void assemble(const typename BondOperator<dim>::AddBlock &add) const override { whole->assemble(add); }
      void visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override
      {
        whole->visit_bond_forces(visit);
      }
      std::vector<double> dilatation() const override { return whole->dilatation(); }
      bool                is_symmetric() const override { return whole->is_symmetric(); }
      std::size_t         memory_consumption() const override { return whole->memory_consumption(); }

    private:
      void scale_softened(const BondForce<dim> &force, TensorWeights<dim> &rest) const
      {
        const NodeRecord *y = force.positions();
        const auto       &x = rest.families->position;
        for (LocalIndex i = 0; i < rest.bonds.n_rows(); ++i)
          for (BondIndex slot = rest.bonds.row[i]; slot < rest.bonds.row[i + 1]; ++slot)
            {
              const LocalIndex       j = rest.bonds.neighbour[slot];
              dealii::Tensor<1, dim> bond;
              for (int d = 0; d < dim; ++d)
                bond[d] = y[j].value[d] - y[i].value[d];
              const SofteningBonds           &softening = force.softening_bonds();
              const dealii::Tensor<1, dim>    along     = x[j] - x[i];
              const double                    left      = softening.share(slot);
              dealii::SymmetricTensor<2, dim> tensor    = left * rest.at(slot);
              if (const double own = softening.stiffness_left(slot, bond.norm() - along.norm()); own > left)
                tensor += (own - left) * (along * (rest.at(slot) * along)) /
                          std::pow(along.norm_square(), 2) *
                          dealii::symmetrize(dealii::outer_product(along, along));
              rest.set(slot, tensor);
            }
      }

      std::shared_ptr<const TensorWeights<dim>> weights;
      std::unique_ptr<TensorOperator<dim>>      whole;
      std::size_t                               n_lost = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<TangentOperator<dim>> create_tangent(const std::shared_ptr<const BondWeights<dim>> &weights)
  {
    if (weights->shape.bond_tensors)
      return std::make_unique<TensorTangent<dim>>(
        std::static_pointer_cast<const TensorWeights<dim>>(weights));
    return visit_family_shape(
      weights->shape, [&](const auto n_sums, const auto own) -> std::unique_ptr<TangentOperator<dim>> {
        return std::make_unique<FamilyTangent<dim, n_sums, own>>(
          std::static_pointer_cast<const FamilyWeights<dim, n_sums, own>>(weights));
      });
  }

  PERIDEAL_INSTANTIATE_CLASS(TangentOperator)
  PERIDEAL_INSTANTIATE(create_tangent)
} // namespace perideal
