// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/node_partitioner.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

// What GradientRows needs of other ranks.

namespace perideal
{
  namespace
  {
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
      std::vector<GlobalIndex>         column;
      std::vector<double>              value;
      std::vector<unsigned int>        pattern;
      std::vector<std::vector<double>> gradient, closed_value, closed_gradient;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &column &value &pattern &gradient &closed_value &closed_gradient;
      }
    };

    template <int dim>
    struct PackedPolynomial
    {
      std::vector<GlobalIndex>                                column;
      std::vector<double>                                     row;
      std::vector<typename PolynomialClosure<dim>::Direction> directions;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &column &row &directions;
      }
    };

    template <int dim>
    std::vector<double> pack(const std::vector<dealii::Tensor<1, dim>> &vectors)
    {
      std::vector<double> result;
      for (const auto &vector : vectors)
        result.insert(result.end(), vector.begin_raw(), vector.end_raw());
      return result;
    }

    template <int dim>
    std::vector<dealii::Tensor<1, dim>> unpack(const std::vector<double> &numbers)
    {
      std::vector<dealii::Tensor<1, dim>> result(numbers.size() / dim);
      for (std::size_t n = 0; n < dim * result.size(); ++n)
        result[n / dim][n % dim] = numbers[n];
      return result;
    }
  } // namespace

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
    const CellGraph<dim> &graph = polynomials.graph();
    if (graph.n_owned() > 0 && number >= graph.global_number(0) &&
        number < graph.global_number(0) + graph.n_owned())
      return number - graph.global_number(0);
    const auto inserted = number_of.insert({number, n_columns()});
    if (inserted.second)
      further.push_back(number);
    return inserted.first->second;
  }

  template <int dim>
  void GradientRows<dim>::exchange_polynomials()
  {
    const CellGraph<dim> &graph = polynomials.graph();
    std::set<LocalIndex>  beyond;
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
        const LocalIndex      i   = number - graph.global_number(0);
        const Terms          *row = polynomials.coefficients(i);
        for (BondIndex k = polynomials.first()[i]; k < polynomials.first()[i + 1]; ++k, ++row)
          {
            result.column.push_back(graph.global_number(polynomials.columns()[k]));
            result.row.insert(result.row.end(), row->begin(), row->end());
          }
        const auto directions = polynomials.closure().directions(i);
        result.directions.assign(directions.begin(), directions.end());
        return result;
      },
      graph.communicator);
    for (const auto &[number, packed] : received)
      {
        Polynomial &polynomial = of_ghosts[number_of.at(number)];
        polynomial.directions  = packed.directions;
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
          result.gradient.push_back(pack(row.gradient[p]));
        for (const auto &share : row.closed)
          {
            result.closed_value.push_back(share.value);
            result.closed_gradient.push_back(pack(share.gradient));
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
          row.gradient[p] = unpack<dim>(packed.gradient[p]);
        for (unsigned int c = 0; c < dim * dim; ++c)
          {
            row.closed[c].value    = packed.closed_value[c];
            row.closed[c].gradient = unpack<dim>(packed.closed_gradient[c]);
          }
      }
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
    const GlobalIndex own_first = graph.n_owned() > 0 ? graph.global_number(0) : 0;
    const GlobalIndex n_all = dealii::Utilities::MPI::sum<GlobalIndex>(graph.n_owned(), graph.communicator);
    NodalVector sum(make_node_partitioner(own_first, graph.n_owned(), n_all, ghosts, n, graph.communicator));
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
