// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/node_partitioner.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace perideal
{
  namespace
  {
    constexpr LocalIndex nowhere = static_cast<LocalIndex>(-1);

    /// Asks ranks for what they have of the numbers, in their order. Collective.
    /// @param answer a rank's own, by number
    template <typename Answer, typename Function>
    std::map<GlobalIndex, Answer> ask(const std::map<unsigned int, std::vector<GlobalIndex>> &wanted,
                                      const Function                                         &answer,
                                      MPI_Comm                                                communicator)
    {
      std::map<unsigned int, std::vector<Answer>> answers;
      for (const auto &[rank, numbers] : dealii::Utilities::MPI::some_to_some(communicator, wanted))
        for (const GlobalIndex number : numbers)
          answers[rank].push_back(answer(number));
      std::map<GlobalIndex, Answer> result;
      for (const auto &[rank, list] : dealii::Utilities::MPI::some_to_some(communicator, answers))
        for (std::size_t k = 0; k < list.size(); ++k)
          result[wanted.at(rank)[k]] = list[k];
      return result;
    }

    /// A row as ranks send it: columns by global number.
    template <int dim>
    struct PackedRow
    {
      std::vector<GlobalIndex>                   column;
      std::vector<double>                        value;
      std::vector<unsigned int>                  pattern;
      std::vector<std::vector<double>>           gradient;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &column &value &pattern &gradient;
      }
    };

    template <int n>
    struct PackedPolynomial
    {
      std::vector<GlobalIndex> column;
      std::vector<double>      row;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &column &row;
      }
    };
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
    for (LocalIndex k = 0; k < graph.n_local(); ++k)
      number_of[graph.global_number(k)] = k;
    collect_sides(prescribed);
    exchange_polynomials();
    place.assign(n_columns(), nowhere);
    exchange_rows(wanted);
    place.assign(n_columns(), nowhere);
  }

  template <int dim>
  void GradientRows<dim>::collect_sides(const FaceValues<dim> &prescribed)
  {
    const LocalIndex n_owned = polynomials.graph().n_owned();
    std::map<unsigned int, std::array<bool, dim>> held;
    for (const auto &entry : prescribed.entries())
      for (int d = 0; d < dim; ++d)
        held[face_moments.boundary_points()[entry.point].face][d] = entry.condition[d] != FaceValues<dim>::free;
    const auto &faces = face_moments.faces();
    first_side.assign(n_owned + 1, 0);
    for (const auto &face : faces)
      for (const LocalIndex node : face.node)
        if (node < n_owned)
          ++first_side[node + 1];
    for (LocalIndex i = 0; i < n_owned; ++i)
      first_side[i + 1] += first_side[i];
    sides.resize(first_side[n_owned]);
    auto next = first_side;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (unsigned int s = 0; s < 2; ++s)
        if (faces[f].node[s] < n_owned)
          {
            Side side{f, s, {}};
            if (f >= face_moments.n_inner_faces())
              if (const auto of = held.find(f - face_moments.n_inner_faces()); of != held.end())
                side.held = of->second;
            sides[next[faces[f].node[s]]++] = side;
          }
  }

  template <int dim>
  unsigned int GradientRows<dim>::owner_of(const GlobalIndex number) const
  {
    // Ranks without nodes stand at the end of the range.
    unsigned int result = 0;
    for (unsigned int rank = 0; rank < first_of_rank.size(); ++rank)
      if (first_of_rank[rank] <= number)
        result = rank;
    return result;
  }

  template <int dim>
  LocalIndex GradientRows<dim>::column_of(const GlobalIndex number)
  {
    const auto inserted = number_of.insert({number, n_columns()});
    if (inserted.second)
      further.push_back(number);
    return inserted.first->second;
  }

  template <int dim>
  void GradientRows<dim>::exchange_polynomials()
  {
    const CellGraph<dim>  &graph = polynomials.graph();
    std::set<LocalIndex>   beyond;
    for (const auto &face : face_moments.faces())
      for (const LocalIndex node : face.node)
        if (node != FaceMoments<dim>::none && node >= graph.n_owned())
          beyond.insert(node);
    std::map<unsigned int, std::vector<GlobalIndex>> wanted;
    for (const LocalIndex node : beyond)
      wanted[owner_of(graph.global_number(node))].push_back(graph.global_number(node));
    const auto received = ask<PackedPolynomial<dim>>(
      wanted,
      [&](const GlobalIndex number) {
        PackedPolynomial<dim> result;
        const LocalIndex      i = number - graph.global_number(0);
        for (BondIndex k = polynomials.first()[i]; k < polynomials.first()[i + 1]; ++k)
          {
            result.column.push_back(graph.global_number(polynomials.columns()[k]));
            const Terms &row = polynomials.coefficients()[k];
            result.row.insert(result.row.end(), row.begin(), row.end());
          }
        return result;
      },
      graph.communicator);
    for (const auto &[number, packed] : received)
      {
        Polynomial &polynomial = of_ghosts[number_of.at(number)];
        for (std::size_t k = 0; k < packed.column.size(); ++k)
          {
            polynomial.column.push_back(column_of(packed.column[k]));
            Terms row;
            std::copy_n(packed.row.begin() + n_terms * k, n_terms, row.begin());
            polynomial.row.push_back(row);
          }
      }
  }

  template <int dim>
  void GradientRows<dim>::exchange_rows(const std::vector<GlobalIndex> &list)
  {
    const CellGraph<dim>                            &graph = polynomials.graph();
    std::map<unsigned int, std::vector<GlobalIndex>> wanted;
    for (const GlobalIndex number : list)
      wanted[owner_of(number)].push_back(number);
    const auto received = ask<PackedRow<dim>>(
      wanted,
      [&](const GlobalIndex number) {
        Row row;
        compute(number - graph.global_number(0), row);
        PackedRow<dim> result;
        for (const LocalIndex k : row.column)
          result.column.push_back(global_number(k));
        result.value = row.value;
        result.pattern.assign(row.pattern.begin(), row.pattern.end());
        for (unsigned int p = 0; p < row.n_patterns; ++p)
          {
            result.gradient.emplace_back();
            for (const auto &gradient : row.gradient[p])
              result.gradient.back().insert(
                result.gradient.back().end(), gradient.begin_raw(), gradient.end_raw());
          }
        return result;
      },
      graph.communicator);
    for (const auto &[number, packed] : received)
      {
        Row &row = of_others[number];
        for (const GlobalIndex column : packed.column)
          row.column.push_back(column_of(column));
        row.value      = packed.value;
        row.n_patterns = packed.gradient.size();
        std::copy(packed.pattern.begin(), packed.pattern.end(), row.pattern.begin());
        for (unsigned int p = 0; p < row.n_patterns; ++p)
          for (std::size_t k = 0; k < row.column.size(); ++k)
            {
              dealii::Tensor<1, dim> gradient;
              for (int l = 0; l < dim; ++l)
                gradient[l] = packed.gradient[p][dim * k + l];
              row.gradient[p].push_back(gradient);
            }
      }
  }

  template <int dim>
  void GradientRows<dim>::add_map(const Side        &side,
                                  const unsigned int of_polynomial,
                                  const LocalIndex   cell,
                                  Map               &map) const
  {
    using M              = Monomials<dim>;
    const auto   &face   = face_moments.faces()[side.face];
    const double  share  = (side.side == 0 ? 1. : -1.) * face.share[of_polynomial];
    const auto    offset = face.centre - polynomials.centroids()[face.node[of_polynomial]];
    const auto    arm    = face.centre - polynomials.centroids()[cell];
    const double *values = face_moments.values().data() + face.first;
    // Integrals over the face of a monomial about the centre with n_l, and with n_l (x - centre)_k.
    const auto add = [&](const unsigned int coefficient, const unsigned int m, const double factor) {
      auto &to = map.of[coefficient];
      for (unsigned int l = 0; l < dim; ++l)
        {
          const double *t      = values + (face.is_plane ? dim : l * M::n);
          const double  normal = share * factor * (face.is_plane ? values[l] : 1.);
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
      for (BondIndex k = polynomials.first()[node]; k < polynomials.first()[node + 1]; ++k)
        visit(polynomials.columns()[k], polynomials.coefficients()[k]);
    else
      {
        const Polynomial &polynomial = of_ghosts.at(node);
        for (std::size_t k = 0; k < polynomial.column.size(); ++k)
          visit(polynomial.column[k], polynomial.row[k]);
      }
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
    const auto add_polynomial = [&](const LocalIndex node, Map &map) {
      // The constant is the value at the centroid, of which the mean is the unknown.
      const auto means = polynomials.means(node);
      for (unsigned int p = 0; p < M::n_quadratic; ++p)
        for (unsigned int f = 0; f < dim + dim * dim; ++f)
          map.of[1 + dim + p][f] -= means[p] * map.of[0][f];
      const LocalIndex own  = place[node];
      const auto       give = [&](const LocalIndex at, const std::array<double, dim + dim * dim> &sum) {
        for (unsigned int l = 0; l < dim; ++l)
          {
            gradient[at][l] += sum[l];
            for (unsigned int k = 0; k < dim; ++k)
              moment[at][k][l] += sum[dim + dim * k + l];
          }
      };
      std::array<double, dim + dim * dim> at_own = map.of[0];
      visit_polynomial(node, [&](const LocalIndex column, const Terms &terms) {
        std::array<double, dim + dim * dim> sum = {};
        for (unsigned int t = 0; t < n_terms; ++t)
          for (unsigned int f = 0; f < dim + dim * dim; ++f)
            sum[f] += terms[t] * map.of[1 + t][f];
        give(place[column], sum);
        for (unsigned int f = 0; f < dim + dim * dim; ++f)
          at_own[f] -= sum[f];
      });
      give(own, at_own);
    };
    Map own{};
    for (std::size_t s = first_side[i]; s < first_side[i + 1]; ++s)
      if (!sides[s].held[component])
        {
          const auto &face = face_moments.faces()[sides[s].face];
          add_map(sides[s], sides[s].side, i, own);
          if (const LocalIndex other = face.node[1 - sides[s].side]; other != FaceMoments<dim>::none)
            {
              Map of_other{};
              add_map(sides[s], 1 - sides[s].side, i, of_other);
              add_polynomial(other, of_other);
            }
        }
    add_polynomial(i, own);

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
  void GradientRows<dim>::compute(const LocalIndex i, Row &row) const
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

    row.value.assign(row.column.size(), 0.);
    const auto means    = polynomials.means(i);
    row.value[place[i]] = 1.;
    visit_polynomial(i, [&](const LocalIndex column, const Terms &terms) {
      for (unsigned int p = 0; p < means.size(); ++p)
        {
          row.value[place[column]] -= means[p] * terms[dim + p];
          row.value[place[i]] += means[p] * terms[dim + p];
        }
    });

    row.n_patterns = 0;
    for (unsigned int a = 0; a < dim; ++a)
      {
        unsigned int like = 0;
        const auto   differs = [&](const Side &side) { return side.held[a] != side.held[like]; };
        while (like < a && std::any_of(sides.begin() + first_side[i], sides.begin() + first_side[i + 1], differs))
          ++like;
        row.pattern[a] = like < a ? row.pattern[like] : row.n_patterns;
        if (like == a)
          fill_pattern(i, a, row.n_patterns++, row);
      }
    for (const LocalIndex column : row.column)
      place[column] = nowhere;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  GradientRows<dim>::sum_to_owners(const std::vector<dealii::Tensor<2, dim>> &blocks) const
  {
    const CellGraph<dim>    &graph = polynomials.graph();
    constexpr unsigned int   n     = dim * dim;
    std::vector<GlobalIndex> ghosts;
    for (LocalIndex k = graph.n_owned(); k < n_columns(); ++k)
      ghosts.push_back(global_number(k));
    const GlobalIndex n_all = dealii::Utilities::MPI::sum<GlobalIndex>(graph.n_owned(), graph.communicator);
    NodalVector       sum(make_node_partitioner(
      graph.global_number(0), graph.n_owned(), n_all, ghosts, n, graph.communicator));
    for (LocalIndex k = 0; k < n_columns(); ++k)
      for (unsigned int c = 0; c < n; ++c)
        sum(n * global_number(k) + c) = blocks[k][c / dim][c % dim];
    sum.compress(dealii::VectorOperation::add);
    std::vector<dealii::Tensor<2, dim>> result(graph.n_owned());
    for (LocalIndex i = 0; i < graph.n_owned(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        result[i][c / dim][c % dim] = sum.local_element(n * i + c);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientRows)
} // namespace perideal
