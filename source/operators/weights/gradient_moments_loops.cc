// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <algorithm>

// The hot loops of GradientMoments over cells, and their transposes.

namespace perideal
{
  namespace
  {
    /// Whether the polynomial of a cell is closed, in whose list it is the n-th or the next one is.
    template <int dim>
    bool is_closed(const CellPolynomials<dim> &polynomials, const LocalIndex i, const std::size_t n)
    {
      const auto &cells = polynomials.closure().cells();
      return n < cells.size() && cells[n] == i;
    }
  } // namespace

  template <int dim>
  void GradientMoments<dim>::read_polynomials(const NodalVector &displacement, const CellSubset *some) const
  {
    const LoopOver<LocalIndex> nodes(some ? &some->nodes : nullptr, n_owned_cells);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < dim; ++d)
        work.displacement[nodes[n]].value[d] = displacement.local_element(dim * nodes[n] + d);
    update_ghosts(*of_displacements, work.displacement, work.temporary);
    constexpr unsigned int     n_terms = Monomials<dim>::n_terms;
    const NodeRecord          *u       = work.displacement.data();
    const auto                &first = polynomials->first(), &columns = polynomials->columns();
    const auto                &closure = polynomials->closure();
    auto                       closed  = closure.cells().begin();
    const LoopOver<LocalIndex> cells(some ? &some->polynomials : nullptr, n_owned_cells);
    for (std::size_t n = 0; n < cells.size(); ++n)
      {
        const LocalIndex i          = cells[n];
        Lanes            c[n_terms] = {};
        const Lanes      own        = lanes(u[i]);
        const double    *row        = polynomials->coefficients(i)->data();
        for (BondIndex k = first[i]; k < first[i + 1]; ++k, row += n_terms)
          {
            const Lanes difference = lanes(u[columns[k]]) - own;
            for (unsigned int t = 0; t < n_terms; ++t)
              c[t] += row[t] * difference;
          }
        while (closed != closure.cells().end() && *closed < i)
          ++closed;
        if (closed != closure.cells().end() && *closed == i)
          closure.close(closed - closure.cells().begin(), c);
        Lanes      value      = own;
        const auto of_unknown = polynomials->at_unknown(i);
        for (unsigned int p = 0; p < of_unknown.size(); ++p)
          value -= of_unknown[p] * c[dim + p];
        NodeRecord *result = work.polynomial.data() + n_coefficients * i;
        lanes(result[0])   = value;
        for (unsigned int t = 0; t < n_terms; ++t)
          lanes(result[1 + t]) = c[t];
      }
  }

  template <int dim>
  void GradientMoments<dim>::read(const NodalVector &displacement,
                                  const AtFaces      at_faces,
                                  const CellSubset  *some) const
  {
    read_polynomials(displacement, some);
    update_ghosts(*of_polynomials, work.polynomial, work.temporary);
    sum_over_faces(at_faces, some);
    visit_gradients(some, n_owned_cells, [&](const LocalIndex i) {
      const double volume = polynomials->volumes()[i];
      NodeRecord  *g = gradient(i), *h = moment(i);
      const auto   means = polynomials->means(i);
      // The trace is that of the polynomial, int (x - x_i).grad p.
      Lanes change = {};
      for (unsigned int p = 0; p < means.size(); ++p)
        change += (2. * volume * means[p]) * lanes(work.polynomial[n_coefficients * i + 1 + dim + p]);
      for (unsigned int l = 0; l < dim; ++l)
        {
          lanes(g[l]) *= 1. / volume;
          change -= lanes(h[(dim + 1) * l]);
        }
      for (unsigned int l = 0; l < dim; ++l)
        lanes(h[(dim + 1) * l]) += (1. / dim) * change;
    });
  }

  template <int dim>
  void GradientMoments<dim>::spread_cell(const LocalIndex i, const std::size_t n) const
  {
    constexpr unsigned int n_terms = Monomials<dim>::n_terms;
    NodeRecord            *f       = work.displacement.data();
    const auto            &first = polynomials->first(), &columns = polynomials->columns();
    const NodeRecord      *acting   = work.polynomial.data() + n_coefficients * i;
    const Lanes            on_value = lanes(acting[0]) + lanes(work.value_force[i]);
    const Lanes            on_trace = (2. * polynomials->volumes()[i]) * lanes(work.trace_force[i]);
    const auto             means = polynomials->means(i), of_unknown = polynomials->at_unknown(i);
    Lanes                  c[n_terms];
    for (unsigned int t = 0; t < n_terms; ++t)
      c[t] = lanes(acting[1 + t]);
    for (unsigned int p = 0; p < means.size(); ++p)
      c[dim + p] += means[p] * on_trace - of_unknown[p] * on_value;
    if (is_closed(*polynomials, i, n))
      polynomials->closure().add_transposed(n, c);
    Lanes         own = on_value;
    const double *row = polynomials->coefficients(i)->data();
    for (BondIndex k = first[i]; k < first[i + 1]; ++k, row += n_terms)
      {
        Lanes sum = row[0] * c[0];
        for (unsigned int t = 1; t < n_terms; ++t)
          sum += row[t] * c[t];
        lanes(f[columns[k]]) += sum;
        own -= sum;
      }
    lanes(f[i]) += own;
  }

  template <int dim>
  void GradientMoments<dim>::spread_to_nodes(NodalVector &force, const CellSubset *some) const
  {
    NodeRecord                *f = work.displacement.data();
    const LoopOver<LocalIndex> nodes(some ? &some->nodes : nullptr, n_owned_cells);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      f[nodes[n]] = NodeRecord{};
    std::fill(f + n_owned_cells, work.displacement.end(), NodeRecord{});
    const auto                &closed   = polynomials->closure().cells();
    std::size_t                n_closed = 0;
    const LoopOver<LocalIndex> cells(some ? &some->polynomials : nullptr, n_owned_cells);
    for (std::size_t n = 0; n < cells.size(); ++n)
      {
        while (n_closed < closed.size() && closed[n_closed] < cells[n])
          ++n_closed;
        spread_cell(cells[n], n_closed);
      }
    add_to_owners(*of_displacements, work.displacement, work.temporary);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * nodes[n] + d) = f[nodes[n]].value[d];
  }

  template <int dim>
  void GradientMoments<dim>::add_nodal_forces(const PolynomialLoads<dim> &loads, NodalVector &force) const
  {
    std::fill(work.displacement.begin(), work.displacement.end(), NodeRecord{});
    const auto &closed = polynomials->closure().cells();
    for (const auto &[i, of_coefficient] : loads.by_cell())
      {
        work.value_force[i] = work.trace_force[i] = NodeRecord{};
        for (unsigned int m = 0; m < n_coefficients; ++m)
          {
            NodeRecord &acting = work.polynomial[n_coefficients * i + m];
            acting             = NodeRecord{};
            for (int a = 0; a < dim; ++a)
              acting.value[a] = of_coefficient[m][a];
          }
        spread_cell(i, std::lower_bound(closed.begin(), closed.end(), i) - closed.begin());
      }
    add_to_owners(*of_displacements, work.displacement, work.temporary);
    for (LocalIndex i = 0; i < n_owned_cells; ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) += work.displacement[i].value[d];
  }

  template <int dim>
  void GradientMoments<dim>::transpose(NodalVector &force, const CellSubset *some) const
  {
    if (some)
      for (const LocalIndex i : some->without_gradient)
        work.value_force[i] = work.trace_force[i] = NodeRecord{};
    visit_gradients(some, n_owned_cells, [&](const LocalIndex i) {
      const double volume = polynomials->volumes()[i];
      NodeRecord  *g = gradient(i), *h = moment(i);
      Lanes        trace = {};
      for (unsigned int l = 0; l < dim; ++l)
        {
          lanes(g[l]) *= 1. / volume;
          trace += (1. / dim) * lanes(h[(dim + 1) * l]);
        }
      for (unsigned int l = 0; l < dim; ++l)
        lanes(h[(dim + 1) * l]) -= trace;
      lanes(work.trace_force[i]) = trace;
    });
    spread_to_faces(some);
    spread_to_nodes(force, some);
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientMoments)
} // namespace perideal
