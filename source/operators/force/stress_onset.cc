// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/intact_gradients.h>
#include <perideal/operators/force/stress_onset.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  namespace
  {
    /// Share of their strength from which on the bonds of a node know when they begin, which the first do at
    /// .7 to .8 of it [-].
    constexpr double near_to_strength = 0.6;
    /// Cells do not know what broke, and strain more beside it: where they have this share of that, nodes are
    /// looked at [-].
    constexpr double share_of_cells = 0.9;
  } // namespace

  template <int dim>
  void StressOnset<dim>::keep(const Families<dim> &families, const BondForce<dim> &bonds, const bool judged)
  {
    if (!is_awaited() || (!judged && borne.size() > 0))
      return;
    // A copy would leave out the ghosts.
    NodalVector now = displacement_of(families, bonds);
    borne.swap(now);
  }

  template <int dim>
  bool StressOnset<dim>::start(const ConsistentForce<dim> &cells,
                               const Families<dim>        &families,
                               BreakingBonds<dim>         &bonds,
                               const std::vector<double>  &chi)
  {
    if (!is_awaited() || borne.size() == 0)
      return false;
    const auto utilisation = [&](const LocalIndex i, const dealii::Tensor<2, dim> &gradient) {
      return criterion.utilisation(i, cells.law(i).cauchy_stress(gradient));
    };
    const auto              of_cells = cells.gradients();
    std::vector<LocalIndex> nodes;
    for (LocalIndex i = 0; i < of_cells.size(); ++i)
      if (chi[i] > 0 && !is_reached[i] && utilisation(i, of_cells[i]) >= share_of_cells * near_to_strength)
        nodes.push_back(i);
    const unsigned int any = nodes.empty() ? 0 : 1;
    if (dealii::Utilities::MPI::max(any, families.communicator) == 0)
      return false;
    const auto gradients = intact_gradients(families, bonds, displacement_of(families, bonds), nodes);
    std::vector<SofteningOnset> onset;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      {
        const LocalIndex              i      = nodes[k];
        const dealii::Tensor<2, dim> &g      = gradients[k];
        const double                  share  = utilisation(i, g);
        const auto                    strain = symmetrize(g + 0.5 * transpose(g) * g);
        const double                  most   = eigenvalues(strain)[0];
        // What is pressed together only does not open.
        if (share < near_to_strength || !(most > 0))
          continue;
        is_reached[i]               = true;
        const double across         = (trace(strain) - most) / (dim - 1.);
        const auto [along, lateral] = criterion.uniaxial(i);
        onset.push_back({i, most / share, -across / most, along, lateral});
      }
    return bonds.start_softening(onset, borne);
  }

  PERIDEAL_INSTANTIATE_CLASS(StressOnset)
} // namespace perideal
