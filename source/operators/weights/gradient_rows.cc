// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    constexpr LocalIndex nowhere = static_cast<LocalIndex>(-1);
  } // namespace

  template <int dim>
  GradientRows<dim>::GradientRows(const CellPolynomials<dim>     &polynomials,
                                  const FaceMoments<dim>         &face_moments,
                                  const FaceValues<dim>          &prescribed,
                                  const std::vector<GlobalIndex> &wanted)
    : polynomials(polynomials)
    , face_moments(face_moments)
  {
    const CellGraph<dim> &graph = polynomials.graph();
    first_of_rank               = dealii::Utilities::MPI::all_gather(
      graph.communicator, graph.n_owned() > 0 ? graph.global_number(0) : GlobalIndex(-1));
    for (LocalIndex k = graph.n_owned(); k < graph.n_local(); ++k)
      number_of[graph.global_number(k)] = k;
    collect_sides(prescribed);
    exchange_polynomials();
    place.assign(n_columns(), nowhere);
    exchange_rows(wanted);
    place.assign(n_columns(), nowhere);
  }

  template <int dim>
  void GradientRows<dim>::add_map(const Side &side, const unsigned int of_polynomial, Map &map) const
  {
    using M              = Monomials<dim>;
    const auto   &shape  = face_moments.shape_of(face_moments.faces()[side.face]);
    const double  share  = (side.side == 0 ? 1. : -1.) * shape.share[of_polynomial];
    const auto   &offset = shape.offset[of_polynomial], &arm = shape.offset[side.side];
    const double *values = face_moments.moments_of(shape);
    // Integrals over the face of a monomial about the centre with n_l, and with n_l (x - centre)_k.
    const auto add = [&](const unsigned int coefficient, const unsigned int m, const double factor) {
      auto &to = map.of[coefficient];
      for (unsigned int l = 0; l < dim; ++l)
        {
          const double *t      = values + (shape.is_plane ? dim : l * M::n);
          const double  normal = share * factor * (shape.is_plane ? values[l] : 1.);
          to[l] += normal * t[m];
          for (unsigned int k = 0; k < dim; ++k)
            to[dim + dim * k + l] += normal * (t[M::times(m, k)] + arm[k] * t[m]);
        }
    };
    // Monomials about the centroid, in those about the centre.
    add(0, 0, 1.);
    for (unsigned int d = 0; d < dim; ++d)
      {
        add(1 + d, 1 + d, 1.);
        add(1 + d, 0, offset[d]);
      }
    for (unsigned int p = 0; p < M::n_quadratic; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        add(1 + dim + p, 1 + dim + p, 1.);
        add(1 + dim + p, 1 + a, offset[b]);
        add(1 + dim + p, 1 + b, offset[a]);
        add(1 + dim + p, 0, offset[a] * offset[b]);
      }
  }

  template <int dim>
  template <typename Visit>
  void GradientRows<dim>::visit_polynomial(const LocalIndex node, const Visit &visit) const
  {
    if (node < polynomials.graph().n_owned())
      {
        const Terms *row = polynomials.coefficients(node);
        for (BondIndex k = polynomials.first()[node]; k < polynomials.first()[node + 1]; ++k, ++row)
          visit(polynomials.columns()[k], *row);
      }
    else
      {
        const Polynomial &polynomial = of_ghosts.at(node);
        for (std::size_t k = 0; k < polynomial.column.size(); ++k)
          visit(polynomial.column[k], polynomial.row[k]);
      }
  }

  template <int dim>
  template <typename Visit>
  void
  GradientRows<dim>::visit_maps(const LocalIndex i, const unsigned int component, const Visit &visit) const
  {
    const auto visit_with_unknown = [&](const LocalIndex node, Map &map) {
      // The constant is the value at the centroid, of which the mean may be the unknown.
      const auto of_unknown = polynomials.at_unknown(node);
      for (unsigned int p = 0; p < of_unknown.size(); ++p)
        for (unsigned int f = 0; f < dim + dim * dim; ++f)
          map.of[1 + dim + p][f] -= of_unknown[p] * map.of[0][f];
      visit(node, map);
    };
    Map own{};
    for (std::size_t s = first_side[i]; s < first_side[i + 1]; ++s)
      if (!sides[s].held[component])
        {
          const auto &face = face_moments.faces()[sides[s].face];
          add_map(sides[s], sides[s].side, own);
          if (const LocalIndex other = face.node[1 - sides[s].side]; other != FaceMoments<dim>::none)
            {
              Map of_other{};
              add_map(sides[s], 1 - sides[s].side, of_other);
              visit_with_unknown(other, of_other);
            }
        }
    visit_with_unknown(i, own);
  }

  template <int dim>
  void GradientRows<dim>::fill_pattern(const LocalIndex   i,
                                       const unsigned int component,
                                       const unsigned int pattern,
                                       Row               &row) const
  {
    using M        = Monomials<dim>;
    auto &gradient = row.gradient[pattern];
    auto &moment   = row.moment[pattern];
    gradient.assign(row.column.size(), {});
    moment.assign(row.column.size(), {});
    visit_maps(i, component, [&](const LocalIndex node, const Map &map) {
      const auto give = [&](const LocalIndex at, const std::array<double, dim + dim * dim> &sum) {
        for (unsigned int l = 0; l < dim; ++l)
          {
            gradient[at][l] += sum[l];
            for (unsigned int k = 0; k < dim; ++k)
              moment[at][k][l] += sum[dim + dim * k + l];
          }
      };
      std::array<double, dim + dim *dim> at_own = map.of[0];
      visit_polynomial(node, [&](const LocalIndex column, const Terms &terms) {
        std::array<double, dim + dim *dim> sum = {};
        for (unsigned int t = 0; t < n_terms; ++t)
          for (unsigned int f = 0; f < dim + dim * dim; ++f)
            sum[f] += terms[t] * map.of[1 + t][f];
        give(place[column], sum);
        for (unsigned int f = 0; f < dim + dim * dim; ++f)
          at_own[f] -= sum[f];
      });
      give(place[node], at_own);
    });

    const double volume = polynomials.volumes()[i];
    const auto   means  = polynomials.means(i);
    for (std::size_t k = 0; k < row.column.size(); ++k)
      {
        gradient[k] /= volume;
        const double change = trace(moment[k]) / dim;
        for (int d = 0; d < dim; ++d)
          moment[k][d][d] -= change;
      }
    visit_polynomial(i, [&](const LocalIndex column, const Terms &terms) {
      double part = 0;
      for (unsigned int p = 0; p < M::n_quadratic; ++p)
        part += 2. * volume * means[p] * terms[dim + p] / dim;
      for (int d = 0; d < dim; ++d)
        {
          moment[place[column]][d][d] += part;
          moment[place[i]][d][d] -= part;
        }
    });
  }

  template <int dim>
  dealii::ArrayView<const typename PolynomialClosure<dim>::Direction>
  GradientRows<dim>::directions_of(const LocalIndex node) const
  {
    if (node < polynomials.graph().n_owned())
      return polynomials.closure().directions(node);
    const auto &directions = of_ghosts.at(node).directions;
    return {directions.data(), directions.size()};
  }

  template <int dim>
  void GradientRows<dim>::add_closure(const LocalIndex   i,
                                      const unsigned int component,
                                      const LocalIndex   node,
                                      const Map         &map,
                                      const Direction   &direction,
                                      Row               &row) const
  {
    // What the direction itself gives.
    const double           volume = polynomials.volumes()[i];
    dealii::Tensor<1, dim> gradient;
    dealii::Tensor<2, dim> moment;
    for (unsigned int t = 0; t < n_terms; ++t)
      for (unsigned int l = 0; l < dim; ++l)
        {
          gradient[l] += direction.polynomial[t] * map.of[1 + t][l] / volume;
          for (unsigned int k = 0; k < dim; ++k)
            moment[k][l] += direction.polynomial[t] * map.of[1 + t][dim + dim * k + l];
        }
    // The value keeps the mean, and the trace is that of the cell's own polynomial.
    double value = 0, change = trace(moment) / dim;
    if (node == i)
      {
        const auto means = polynomials.means(i);
        for (unsigned int p = 0; p < means.size(); ++p)
          value -= means[p] * direction.polynomial[dim + p];
        change += 2. * volume * value / dim;
      }
    for (int d = 0; d < dim; ++d)
      moment[d][d] -= change;

    for (unsigned int b = 0; b < dim; ++b)
      {
        typename Row::Share &share = row.closed[dim * component + b];
        const auto           give  = [&](const LocalIndex at, const double amount) {
          share.value[at] += amount * value;
          share.gradient[at] += amount * gradient;
          share.moment[at] += amount * moment;
        };
        visit_polynomial(node, [&](const LocalIndex column, const Terms &terms) {
          double amount = 0;
          for (unsigned int p = 0; p < Monomials<dim>::n_quadratic; ++p)
            amount += direction.answer[dim * p + b].value[component] * terms[dim + p];
          give(place[column], amount);
          give(place[node], -amount);
        });
      }
  }

  template <int dim>
  void GradientRows<dim>::fill_closures(const LocalIndex i, Row &row) const
  {
    bool any = directions_of(i).size() > 0;
    for (std::size_t s = first_side[i]; s < first_side[i + 1]; ++s)
      if (const LocalIndex other = face_moments.faces()[sides[s].face].node[1 - sides[s].side];
          other != FaceMoments<dim>::none)
        any = any || directions_of(other).size() > 0;
    for (auto &share : row.closed)
      {
        share.value.assign(any ? row.column.size() : 0, 0.);
        share.gradient.assign(share.value.size(), {});
        share.moment.assign(share.value.size(), {});
      }
    for (unsigned int a = 0; any && a < dim; ++a)
      visit_maps(i, a, [&](const LocalIndex node, const Map &map) {
        for (const Direction &direction : directions_of(node))
          add_closure(i, a, node, map, direction, row);
      });
  }

  template <int dim>
  void GradientRows<dim>::list_columns(const LocalIndex i, Row &row) const
  {
    take_columns(i, row);
    for (const LocalIndex column : row.column)
      place[column] = nowhere;
  }

  template <int dim>
  void GradientRows<dim>::take_columns(const LocalIndex i, Row &row) const
  {
    row.column.clear();
    const auto take = [&](const LocalIndex column) {
      if (place[column] == nowhere)
        {
          place[column] = row.column.size();
          row.column.push_back(column);
        }
    };
    const auto take_polynomial = [&](const LocalIndex node) {
      take(node);
      visit_polynomial(node, [&](const LocalIndex column, const Terms &) { take(column); });
    };
    take_polynomial(i);
    for (std::size_t s = first_side[i]; s < first_side[i + 1]; ++s)
      if (const LocalIndex other = face_moments.faces()[sides[s].face].node[1 - sides[s].side];
          other != FaceMoments<dim>::none)
        take_polynomial(other);
  }

  template <int dim>
  void GradientRows<dim>::compute(const LocalIndex i, Row &row) const
  {
    take_columns(i, row);
    row.value.assign(row.column.size(), 0.);
    const auto of_unknown = polynomials.at_unknown(i);
    row.value[place[i]]   = 1.;
    visit_polynomial(i, [&](const LocalIndex column, const Terms &terms) {
      for (unsigned int p = 0; p < of_unknown.size(); ++p)
        {
          row.value[place[column]] -= of_unknown[p] * terms[dim + p];
          row.value[place[i]] += of_unknown[p] * terms[dim + p];
        }
    });

    row.n_patterns = 0;
    for (unsigned int a = 0; a < dim; ++a)
      {
        unsigned int like    = 0;
        const auto   differs = [&](const Side &side) { return side.held[a] != side.held[like]; };
        while (like < a &&
               std::any_of(sides.begin() + first_side[i], sides.begin() + first_side[i + 1], differs))
          ++like;
        row.pattern[a] = like < a ? row.pattern[like] : row.n_patterns;
        if (like == a)
          fill_pattern(i, a, row.n_patterns++, row);
      }
    fill_closures(i, row);
    for (const LocalIndex column : row.column)
      place[column] = nowhere;
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientRows)
} // namespace perideal
