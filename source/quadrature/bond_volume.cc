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

  void QuadratureParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Quadrature");
    prm.add_parameter(
      "Scheme",
      scheme,
      "How much of a neighbour's volume a bond counts: one point: all of it where the neighbour lies within "
      "the horizon; cubic cell: of these neighbours the part of their cells that does, taken as linear in "
      "the distance; partial volume: that part also of cells with their centre outside; exact: the part of "
      "each "
      "cell that the horizon cuts, for cells of any shape; adaptive: the same by integration with error "
      "control; gauss points: several points in each cell, with displacements interpolated by moving least "
      "squares "
      "(bond based, statics; all but one point: not with the consistent form)",
      Selection("one point|cubic cell|partial volume|adaptive|exact|gauss points"));
    prm.add_parameter("Adaptive rule",
                      adaptive_rule,
                      "Points of adaptive integration: gauss: Gauss points between the kinks of its limits; "
                      "trapezoid: intervals that are halved, as in K. Yu's thesis, up to a million points a "
                      "cell, which takes a thousand times longer",
                      Selection("gauss|trapezoid"));
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Adaptive integration ends when a share changes by less than this, over the share "
                      "itself; above 0 [-]",
                      Double());
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "Share of a cell from which on down the relative tolerance is one of the whole cell; "
                      "above 0 [-]",
                      Double());
    prm.add_parameter(
      "Gauss points", gauss_points, "Gauss points of a cell in each direction [-]", Integer(1, 4));
    prm.add_parameter(
      "Support radius",
      support_radius,
      "Gauss points: radius within which nodes make the displacement of a point, in spacings of its "
      "cell, 1.5 to 6 [-]",
      Double());
    prm.leave_subsection();
  }

  void QuadratureParameters::check() const
  {
    const auto check_tolerance = [](const double value, const std::string &name) {
      if (!(value > 0))
        throw InputError("integration never gets there")
          .parameter("Quadrature/" + name)
          .allowed("above 0; 1e-6 is usual");
    };
    check_tolerance(relative_tolerance, "Relative tolerance");
    check_tolerance(absolute_tolerance, "Absolute tolerance");
    if (!(support_radius >= 1.5 && support_radius <= 6.))
      throw InputError("no quadratic fit has such supports")
        .parameter("Quadrature/Support radius")
        .given(std::to_string(support_radius))
        .allowed("1.5 to 6; 3 is usual");
  }

  template <int dim>
  void prepare_cells(const QuadratureParameters &parameters, const Mesh<dim> &mesh, Nodes<dim> &nodes)
  {
    if (parameters.needs_cells())
      nodes.keep_cells(mesh);
    else if (parameters.has_gauss_points())
      nodes.set_cell_radius(nodes.cell_radii(mesh));
    else if (parameters.scheme == "partial volume")
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
    if (parameters.scheme == "exact")
      return create_exact_shares<dim>();
    if (parameters.scheme == "adaptive")
      return create_adaptive_shares<dim>(parameters.adaptive_rule == "gauss" ? IntegrationRule::gauss :
                                                                               IntegrationRule::trapezoid,
                                         {parameters.relative_tolerance, parameters.absolute_tolerance});
    if (parameters.has_gauss_points())
      return std::make_shared<TouchedCells<dim>>();
    if (parameters.counts_parts())
      return std::make_shared<LinearShares<dim>>(parameters.scheme == "cubic cell");
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
