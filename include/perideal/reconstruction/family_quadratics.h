// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_family_quadratics_h
#define perideal_reconstruction_family_quadratics_h

#include <perideal/base/types.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/reconstruction/monomials.h>

#include <deal.II/base/tensor.h>

#include <Eigen/Core>

#include <vector>

namespace perideal
{
  /**
   * Computes gradients of a nodal field at some nodes from the quadratic polynomials that fit it best, by
   * least squares weighted with volumes, over a node and those members of its family that are added. Like
   * FamilyFit, which is linear, but exact for quadratic fields beside surfaces and cracks too, where members
   * lie on one side of their node; no better within the body.
   */
  template <int dim>
  class FamilyQuadratics
  {
  public:
    /// @param field dim values a node, laid out as families.make_partitioner(dim), ghosts up to date. Both
    /// arguments must outlive this object.
    /// @param nodes owned ones, at which gradients are asked for
    FamilyQuadratics(const Families<dim>           &families,
                     const NodalVector             &field,
                     const std::vector<LocalIndex> &nodes);

    /// Adds local node @p j to the fit of local node @p i, unless that is none of those asked for.
    void add(const LocalIndex i, const LocalIndex j)
    {
      if (i < place.size() && place[i] != nowhere)
        add_to(place[i], i, j);
    }

    /// Returns (d u_a/d x_b) by node asked for, in their order; of smallest norm where members do not
    /// determine all of the polynomial.
    std::vector<dealii::Tensor<2, dim>> gradients() const;

  private:
    static constexpr LocalIndex   nowhere = -1;
    static constexpr unsigned int n_terms = Monomials<dim>::n_coefficients;

    /// Normal equations, with distances over the horizon.
    struct Moments
    {
      Eigen::Matrix<double, n_terms, n_terms> of_terms  = Eigen::Matrix<double, n_terms, n_terms>::Zero();
      Eigen::Matrix<double, n_terms, dim>     of_values = Eigen::Matrix<double, n_terms, dim>::Zero();
    };

    void add_to(const LocalIndex fit, const LocalIndex i, const LocalIndex j);

    const Families<dim>    &families;
    const NodalVector      &field;
    std::vector<LocalIndex> nodes;
    /// Of owned nodes among those asked for.
    std::vector<LocalIndex> place;
    std::vector<Moments>    moments;
  };
} // namespace perideal

#endif
