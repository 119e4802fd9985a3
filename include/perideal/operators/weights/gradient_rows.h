// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_gradient_rows_h
#define perideal_operators_weights_gradient_rows_h

#include <perideal/boundary/face_values.h>
#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/face_moments.h>

#include <array>
#include <map>
#include <vector>

namespace perideal
{
  /**
   * Writes out GradientMoments as rows of a matrix, cell by cell: for diagonal blocks and assembly.
   *
   * Columns are numbered as the nodes of the cell graph; behind these come others that rows of other ranks
   * reach.
   */
  template <int dim>
  class GradientRows
  {
  public:
    /// What the value at the centroid, the gradient and its moment of a cell take of each column. Components
    /// of the displacement whose prescribed faces differ have rows of their own.
    struct Row
    {
      std::vector<LocalIndex>                              column;
      std::vector<double>                                  value;
      std::array<unsigned int, dim>                        pattern    = {};
      unsigned int                                         n_patterns = 1;
      std::array<std::vector<dealii::Tensor<1, dim>>, dim> gradient;
      std::array<std::vector<dealii::Tensor<2, dim>>, dim> moment;

      const std::vector<dealii::Tensor<1, dim>> &gradient_of(const unsigned int component) const
      {
        return gradient[pattern[component]];
      }
      const std::vector<dealii::Tensor<2, dim>> &moment_of(const unsigned int component) const
      {
        return moment[pattern[component]];
      }
    };

    /// Collective.
    /// @param wanted cells of other ranks of which at() gives rows too, without moments
    GradientRows(const CellPolynomials<dim>     &polynomials,
                 const FaceMoments<dim>         &face_moments,
                 const FaceValues<dim>          &prescribed,
                 const std::vector<GlobalIndex> &wanted);

    /// Computes the row of an owned cell.
    void compute(const LocalIndex i, Row &row) const;

    /// The row of a wanted cell.
    const Row &at(const GlobalIndex cell) const { return of_others.at(cell); }

    LocalIndex  n_columns() const { return polynomials.graph().n_local() + further.size(); }
    GlobalIndex global_number(const LocalIndex k) const
    {
      const LocalIndex n = polynomials.graph().n_local();
      return k < n ? polynomials.graph().global_number(k) : further[k - n];
    }

    /// Adds what ranks have for each other's columns to the blocks of owned nodes. Collective.
    std::vector<dealii::Tensor<2, dim>>
    sum_to_owners(const std::vector<dealii::Tensor<2, dim>> &blocks) const;

  private:
    static constexpr unsigned int n_terms = Monomials<dim>::n_terms;
    using Terms                           = typename CellPolynomials<dim>::Terms;
    /// A polynomial of a neighbour on another rank.
    struct Polynomial
    {
      std::vector<LocalIndex> column;
      std::vector<Terms>      row;
    };
    /// A face of an owned cell, seen from it.
    struct Side
    {
      std::size_t  face;
      unsigned int side;
      /// By component, whether its value is prescribed there.
      std::array<bool, dim> held;
    };
    /// What a polynomial gives to V G and H of a cell, by coefficient.
    struct Map
    {
      std::array<std::array<double, dim + dim * dim>, Monomials<dim>::n_coefficients> of;
    };

    void       collect_sides(const FaceValues<dim> &prescribed);
    void       exchange_polynomials();
    void       exchange_rows(const std::vector<GlobalIndex> &wanted);
    LocalIndex column_of(const GlobalIndex number);
    unsigned   owner_of(const GlobalIndex number) const;
    void add_map(const Side &side, const unsigned int of_polynomial, const LocalIndex cell, Map &map) const;
    template <typename Visit>
    void visit_polynomial(const LocalIndex node, const Visit &visit) const;
    void fill_pattern(const LocalIndex   i,
                      const unsigned int component,
                      const unsigned int pattern,
                      Row               &row) const;

    const CellPolynomials<dim>       &polynomials;
    const FaceMoments<dim>           &face_moments;
    std::vector<GlobalIndex>          first_of_rank, further;
    std::map<GlobalIndex, LocalIndex> number_of;
    std::vector<std::size_t>          first_side;
    std::vector<Side>                 sides;
    std::map<LocalIndex, Polynomial>  of_ghosts;
    std::map<GlobalIndex, Row>        of_others;
    /// Work space: where a column stands in the row that is made.
    mutable std::vector<LocalIndex> place;
  };
} // namespace perideal

#endif
