// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/quadrature/bond_volume.h>
#include <perideal/quadrature/cell_shares.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Squares and cubes thought to lie across their bonds.
    template <int dim>
    class LinearShares : public VolumeRule<dim>
    {
    public:
      /// @param cuts_off whether only nodes within the horizon count
      explicit LinearShares(const bool cuts_off)
        : cuts_off(cuts_off)
      {
      }

      double share(const Families<dim> &families, const LocalIndex i, const LocalIndex j) const override
      {
        // As in the search: nodes at the rim of a horizon of whole cells are within.
        constexpr double hair   = 1 + 1e-9;
        const double     length = families.position[i].distance(families.position[j]);
        if (cuts_off && length > hair * families.horizon[i])
          return 0.;
        const double share = linear_share(families.horizon[i], families.spacing[j], length);
        return share < VolumeRule<dim>::negligible ? 0. : share;
      }

    private:
      const bool cuts_off;
    };

    /// All of the cells that a horizon may cut: what counts of them is up to their points.
    template <int dim>
    class TouchedCells : public VolumeRule<dim>
    {
    public:
      double share(const Families<dim> &families, const LocalIndex i, const LocalIndex j) const override
      {
        const double length = families.position[i].distance(families.position[j]);
        return length < families.horizon[i] + families.cell_radius[j] ? 1. : 0.;
      }
    };
  } // namespace

  template <int dim>
  void prepare_cells(const QuadratureParameters &parameters, const Mesh<dim> &mesh, Nodes<dim> &nodes)
  {
    if (parameters.needs_cells())
      nodes.keep_cells(mesh);
    else if (parameters.has_gauss_points())
      nodes.set_cell_radius(nodes.cell_radii(mesh));
    else if (parameters.scheme == QuadratureScheme::partial_volume)
      {
        std::vector<double> radius = nodes.spacing;
        for (double &r : radius)
          r *= 0.5;
        nodes.set_cell_radius(std::move(radius));
      }
  }

  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_volume_rule(const QuadratureParameters &parameters)
  {
    if (parameters.scheme == QuadratureScheme::exact)
      return create_exact_shares<dim>();
    if (parameters.scheme == QuadratureScheme::adaptive)
      return create_adaptive_shares<dim>(parameters.adaptive_rule,
                                         {parameters.relative_tolerance, parameters.absolute_tolerance});
    if (parameters.has_gauss_points())
      return std::make_shared<TouchedCells<dim>>();
    if (parameters.counts_parts())
      return std::make_shared<LinearShares<dim>>(parameters.scheme == QuadratureScheme::cubic_cell);
    return nullptr;
  }

  template <int dim>
  double first_moment(const Families<dim> &families, const LocalIndex i)
  {
    double result = 0;
    for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
      result += counted_volume(families, i, *j) * families.position[i].distance(families.position[*j]);
    return result;
  }

  PERIDEAL_INSTANTIATE(prepare_cells)
  PERIDEAL_INSTANTIATE(create_volume_rule)
  PERIDEAL_INSTANTIATE(first_moment)

} // namespace perideal
