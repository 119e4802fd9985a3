// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_post_areal_force_density_h
#define perideal_operators_post_areal_force_density_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/materials/linear_model.h>
#include <perideal/nodes/nodes.h>
#include <perideal/parameters/areal_force_parameters.h>
#include <perideal/quadrature/bonds_through_plane.h>

#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Evaluates the areal force density tau at points of the body: the force per area that the matter on the
   * side of a plane that its normal n points to exerts on the matter on the other side (QUAD (2.12); Silling
   * 2000),
   *
   *     tau(x, n) = int_0^d ds int_{(x' - x).n >= 0, |x' - xh| <= d} f(x', xh) dV',   xh = x - s n,
   *
   * f the force density on xh of its bond with x'. A uniform deformation has tau = P n, the first
   * Piola-Kirchhoff stress. There are two rules:
   *
   * line: that integral, with the displacement interpolated from the nodes by moving least squares; what lies
   * out of the body counts nothing.
   * bonds: a tensor of the nodes, such as partial_stress(), interpolated in the same way, times n.
   *
   * Horizon and material are those of the node next to the point; other materials are not looked at.
   */
  template <int dim>
  class ArealForceDensity
  {
  public:
    /// The force of bonds of a material with a horizon [m]; empty where the line is of no use.
    using PairForceOf = std::function<PairForce<dim>(const dealii::types::material_id, const double)>;

    /// Radius of the support of interpolations over the spacing of the nearest node; where the nodes in it
    /// make no fit, it is enlarged once.
    static constexpr double support = 3., enlarged = 1.5;

    /// Finds the nodes that each point needs. Collective.
    /// @param nodes of the body, whose numbers the fields below have
    /// @param thickness of a two-dimensional body [m], 1 in 3-D
    /// @throws InputError where there are too few nodes to interpolate, or the line is of no use to a point
    ///   that asks for it.
    ArealForceDensity(const NodeCloud<dim>                    &nodes,
                      const std::vector<BoundaryFace<dim>>    &faces,
                      const double                             thickness,
                      const std::vector<ArealForcePoint<dim>> &points,
                      const PairForceOf                       &pair_force_of);

    std::size_t        size() const { return points.size(); }
    const std::string &name(const std::size_t k) const { return points[k].name; }
    /// Never automatic.
    ArealForceRule rule(const std::size_t k) const
    {
      return places[k].pair_force ? ArealForceRule::line : ArealForceRule::bonds;
    }
    /// Whether any point needs stresses.
    bool needs_stress() const;

    /// tau of each point [Pa], on all ranks. Collective.
    /// @param displacement of the nodes [m]
    /// @param stress of the nodes [Pa]; may be empty where it is not needed
    std::vector<dealii::Tensor<1, dim>> evaluate(const std::vector<dealii::Tensor<1, dim>> &displacement,
                                                 const std::vector<dealii::Tensor<2, dim>> &stress) const;

  private:
    /// Weights of the gathered nodes, of many places: of place p entries first[p] to first[p + 1].
    struct Interpolation
    {
      std::vector<std::size_t>  first = {0};
      std::vector<unsigned int> node;
      std::vector<double>       weight;

      void append(const std::vector<double> &weights);
      /// At place p, of values by node.
      template <typename Value>
      Value at(const std::size_t p, const std::vector<Value> &values) const;
    };

    /// A bond of the line rule, between two places of the interpolation.
    struct Bond
    {
      dealii::Tensor<1, dim> xi;
      double                 weight;
      std::size_t            near, far;
    };

    /// What a point has.
    struct Place
    {
      /// Nodes of this rank that it needs.
      std::vector<LocalIndex> local;
      /// Empty: the rule is bonds.
      PairForce<dim> pair_force;
      // Of the rank that evaluates the point: at either end of each bond, or at the point itself.
      Interpolation     interpolation;
      std::vector<Bond> bonds;
    };

    /// The node next to a point.
    struct Surroundings
    {
      double                     spacing, horizon;
      dealii::types::material_id material;
      /// Whether there is another material within the horizon.
      bool is_mixed;
      /// How far nodes are of use [m].
      double reach;
    };

    /// Adds bonds to a place, with the interpolations at their ends.
    template <typename Fit>
    static void add_bonds(const std::vector<typename BondsThroughPlane<dim>::Fan> &fans,
                          const double                                             thickness,
                          Fit                                                     &fit,
                          Place                                                   &place);

    Surroundings look_around(const NodeCloud<dim> &nodes, const dealii::Point<dim> &x) const;
    Place        make_place(const NodeCloud<dim>                 &nodes,
                            const std::vector<BoundaryFace<dim>> &faces,
                            const double                          thickness,
                            const std::size_t                     k,
                            const PairForceOf                    &pair_force_of) const;
    /// Whether this rank evaluates point k.
    bool is_mine(const std::size_t k) const;

    std::vector<ArealForcePoint<dim>> points;
    std::vector<Place>                places;
    MPI_Comm                          communicator;
  };
} // namespace perideal

#endif
