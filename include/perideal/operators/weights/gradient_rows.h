// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_gradient_rows_h
#define perideal_operators_weights_gradient_rows_h

#include <perideal/base/equal_records.h>
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
    ///
    /// Where polynomials are closed (PolynomialClosure), components of the columns give besides to components
    /// of the cell: what component a takes of component b stands in closed[dim a + b].
    struct Row
    {
      struct Share
      {
        std::vector<double>                 value;
        std::vector<dealii::Tensor<1, dim>> gradient;
        std::vector<dealii::Tensor<2, dim>> moment;
      };
      std::vector<LocalIndex>                              column;
      std::vector<double>                                  value;
      std::array<unsigned int, dim>                        pattern    = {};
      unsigned int                                         n_patterns = 1;
      std::array<std::vector<dealii::Tensor<1, dim>>, dim> gradient;
      std::array<std::vector<dealii::Tensor<2, dim>>, dim> moment;
      std::array<Share, dim * dim>                         closed;

      bool is_closed() const { return !closed[0].value.empty(); }

      const std::vector<dealii::Tensor<1, dim>> &gradient_of(const unsigned int component) const
      {
        return gradient[pattern[component]];
      }
      const std::vector<dealii::Tensor<2, dim>> &moment_of(const unsigned int component) const
      {
        return moment[pattern[component]];
      }

      /// The value, the gradient (du_a/dx_l) and the parts of the moment (k: (x_k - x_ik) du_a/dx_l) that
      /// component b of a column makes, of closed rows.
      dealii::Tensor<1, dim>                  value_by(const std::size_t k, const unsigned int b) const;
      dealii::Tensor<2, dim>                  gradient_by(const std::size_t k, const unsigned int b) const;
      std::array<dealii::Tensor<2, dim>, dim> moments_by(const std::size_t  column,
                                                         const unsigned int b) const;

      /// Frees the moments.
      void forget_moments();
    };

    /// Collective.
    /// @param wanted cells of other ranks of which at() gives rows too, without moments
    GradientRows(const CellPolynomials<dim>     &polynomials,
                 const FaceMoments<dim>         &face_moments,
                 const FaceValues<dim>          &prescribed,
                 const std::vector<GlobalIndex> &wanted);

    /// Computes the row of an owned cell.
    void compute(const LocalIndex i, Row &row) const;
    /// Lists its columns only, in the same order.
    void list_columns(const LocalIndex i, Row &row) const;
    /// Puts what the row of an owned cell depends on into a record: cells of equal records have equal rows
    /// but for their columns.
    /// @return false where a polynomial of another rank or a closed one counts, which nothing is told of
    bool describe(const LocalIndex i, std::vector<EqualRecords::Entry> &record) const;

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
    using Direction                       = typename PolynomialClosure<dim>::Direction;
    /// A polynomial of a neighbour on another rank.
    struct Polynomial
    {
      std::vector<LocalIndex> column;
      std::vector<Terms>      row;
      std::vector<Direction>  directions;
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

    /// Lists the columns, and keeps in `place` where they stand.
    void       take_columns(const LocalIndex i, Row &row) const;
    void       collect_sides(const FaceValues<dim> &prescribed);
    void       exchange_polynomials();
    void       exchange_rows(const std::vector<GlobalIndex> &wanted);
    LocalIndex column_of(const GlobalIndex number);
    unsigned   owner_of(const GlobalIndex number) const;
    void       add_map(const Side &side, const unsigned int of_polynomial, Map &map) const;
    template <typename Visit>
    void visit_polynomial(const LocalIndex node, const Visit &visit) const;
    /// Calls visit(node, map) for the polynomials that a component of a cell's V G and H comes of, that of
    /// the cell and its neighbours'. The mean stays what it is under changes of quadratic coefficients.
    template <typename Visit>
    void visit_maps(const LocalIndex i, const unsigned int component, const Visit &visit) const;
    dealii::ArrayView<const Direction> directions_of(const LocalIndex node) const;
    void                               fill_closures(const LocalIndex i, Row &row) const;
    void                               add_closure(const LocalIndex   i,
                                                   const unsigned int component,
                                                   const LocalIndex   node,
                                                   const Map         &map,
                                                   const Direction   &direction,
                                                   Row               &row) const;
    void                               fill_pattern(const LocalIndex   i,
                                                    const unsigned int component,
                                                    const unsigned int pattern,
                                                    Row               &row) const;

    const CellPolynomials<dim> &polynomials;
    const FaceMoments<dim>     &face_moments;
    std::vector<GlobalIndex>    first_of_rank, further;
    /// Of columns that are not owned.
    std::map<GlobalIndex, LocalIndex> number_of;
    std::vector<std::size_t>          first_side;
    std::vector<Side>                 sides;
    std::map<LocalIndex, Polynomial>  of_ghosts;
    std::map<GlobalIndex, Row>        of_others;
    /// Work space: where a column stands in the row that is made.
    mutable std::vector<LocalIndex> place;
  };

  template <int dim>
  dealii::Tensor<1, dim> GradientRows<dim>::Row::value_by(const std::size_t k, const unsigned int b) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      result[a] = closed[dim * a + b].value[k];
    result[b] += value[k];
    return result;
  }

  template <int dim>
  dealii::Tensor<2, dim> GradientRows<dim>::Row::gradient_by(const std::size_t k, const unsigned int b) const
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      result[a] = closed[dim * a + b].gradient[k];
    result[b] += gradient_of(b)[k];
    return result;
  }

  template <int dim>
  std::array<dealii::Tensor<2, dim>, dim> GradientRows<dim>::Row::moments_by(const std::size_t  column,
                                                                             const unsigned int b) const
  {
    std::array<dealii::Tensor<2, dim>, dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      {
        for (unsigned int a = 0; a < dim; ++a)
          result[k][a] = closed[dim * a + b].moment[column][k];
        result[k][b] += moment_of(b)[column][k];
      }
    return result;
  }

  template <int dim>
  void GradientRows<dim>::Row::forget_moments()
  {
    for (auto &of_pattern : moment)
      of_pattern = {};
    for (Share &share : closed)
      share.moment = {};
  }
} // namespace perideal

#endif
