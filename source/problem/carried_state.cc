// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/problem/carried_state.h>
#include <perideal/reconstruction/quadratic_terms.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Core>

#include <algorithm>
#include <set>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    /// Eigenvalues of normal equations, over the largest, that count as zero.
    constexpr double rank_tolerance = 1e-8;

    /// Whether a bond of an owned node softened or broke.
    std::vector<bool> failed_nodes(const Checkpoint &state, const LocalIndex n_owned)
    {
      std::vector<bool> result(n_owned, false);
      for (const auto &[name, array] : state.bond_arrays)
        for (const BondEnds &bond : array.bonds)
          for (const LocalIndex end : {bond.near, bond.far})
            if (end < n_owned)
              result[end] = true;
      return result;
    }

    /// What a cell of the consistent form takes in a step, in bonds: 200 ns over 7 in 2-D, 660 over 6.4 in
    /// 3-D.
    template <int dim>
    constexpr double bonds_of_cell = dim == 2 ? 30. : 100.;

    /// What a step costs at each owned node, in bonds.
    template <int dim>
    std::vector<double> cost_of_nodes(const Problem<dim> &problem)
    {
      std::vector<double>        result(problem.body.nodes->size(),
                                 problem.parameters.model.is_consistent() ? bonds_of_cell<dim> : 0.);
      std::set<const BondList *> lists;
      if (problem.force)
        lists = {&problem.force->bond_list(), &problem.force->body_bonds()};
      for (LocalIndex i = 0; i < result.size(); ++i)
        {
          if (lists.empty())
            result[i] += problem.discretisation.families->size(i);
          for (const BondList *list : lists)
            result[i] += static_cast<double>(list->row[i + 1] - list->row[i]);
        }
      return result;
    }
  } // namespace

  template <int dim>
  CarriedState<dim>::CarriedState(const Problem<dim>    &problem,
                                  Checkpoint           &&given,
                                  const CheckpointNodes &keyed,
                                  const MeshNeed<dim>   &need)
    : state(std::move(given))
  {
    const Nodes<dim> &nodes = *problem.body.nodes;
    for (auto &[name, array] : state.node_arrays)
      {
        // Where only the first nodes have values, or none has, zeros follow.
        array.values.resize(std::size_t(array.width) * nodes.size(), 0.);
        const bool is_smooth = array.transfer == Transfer::smooth;
        (is_smooth ? smooth : constant).push_back(name);
        (is_smooth ? n_smooth : n_constant) += array.width;
      }
    const std::vector<double> costs  = cost_of_nodes(problem);
    const std::vector<bool>   failed = failed_nodes(state, nodes.size());
    std::vector<Numbers>      of_node(nodes.size());
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        of_node[i] = {failed[i] ? 1. : 0., need.is_quiet[i] ? 1. : 0., costs[i]};
        for (const auto *names : {&constant, &smooth})
          for (const std::string &name : *names)
            {
              const NodeArray &array = state.node_arrays.at(name);
              const auto       first = array.values.begin() + std::size_t(array.width) * i;
              of_node[i].insert(of_node[i].end(), first, first + array.width);
            }
        of_node[i].resize(n_places + n_constant + n_smooth * (1 + n_coefficients), 0.);
      }
    numbers_of_cell.resize(problem.body.mesh->triangulation.n_active_cells());
    for (std::size_t c = 0; c < numbers_of_cell.size(); ++c)
      if (nodes.node_of_cell[c] != dealii::numbers::invalid_unsigned_int)
        numbers_of_cell[c] = std::move(of_node[nodes.node_of_cell[c]]);

    for (const auto &[name, array] : state.bond_arrays)
      {
        KeyedBonds mine;
        for (const BondEnds &bond : array.bonds)
          mine.keys.insert(mine.keys.end(), {keyed.key[bond.near], keyed.key[bond.far]});
        KeyedBonds &all = bonds[name];
        for (const auto &of_rank : dealii::Utilities::MPI::all_gather(nodes.communicator, mine.keys))
          all.keys.insert(all.keys.end(), of_rank.begin(), of_rank.end());
        for (const auto &of_rank : dealii::Utilities::MPI::all_gather(nodes.communicator, array.values))
          all.values.insert(all.values.end(), of_rank.begin(), of_rank.end());
      }
  }

  template <int dim>
  void CarriedState<dim>::fit(const Problem<dim> &problem, const MeshNeed<dim> &need)
  {
    if (n_smooth == 0)
      return;
    const Families<dim>   &families = *problem.discretisation.families;
    const BondList        &list     = problem.force->body_bonds();
    const auto             is_cut   = problem.failure.precrack_test();
    const std::size_t      first    = n_places + n_constant;
    std::vector<Numbers *> of_node(families.n_owned());
    std::vector<bool>      is_wanted(families.n_owned());
    const double           widest = need.widest_layers(*problem.body.mesh);
    for (const auto &cell : problem.body.mesh->triangulation.active_cell_iterators())
      if (Numbers &numbers = numbers_of_cell[cell->active_cell_index()]; !numbers.empty())
        {
          const LocalIndex i = problem.body.nodes->node_of_cell[cell->active_cell_index()];
          of_node[i]         = &numbers;
          is_wanted[i]       = numbers[is_kept] == 0 && need.may_be_halved(cell, widest);
        }
    NodalVector values(families.make_partitioner(n_smooth));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (std::size_t k = 0; k < n_smooth; ++k)
        values.local_element(n_smooth * i + k) = (*of_node[i])[first + k];
    values.update_ghost_values();

    using Matrix = Eigen::Matrix<double, n_coefficients, n_coefficients>;
    struct Equations
    {
      Matrix                                                moments = Matrix::Zero();
      Eigen::Matrix<double, n_coefficients, Eigen::Dynamic> right;
    };
    std::vector<Equations> equations(families.n_owned());
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_wanted[i])
        equations[i].right.setZero(n_coefficients, n_smooth);
    const auto add = [&](const LocalIndex i, const LocalIndex j) {
      const dealii::Tensor<1, dim> d = (families.position[j] - families.position[i]) / families.spacing[i];
      const double                 weight = 1. / d.norm_square();
      const QuadraticTerms<dim>    p      = quadratic_terms(d);
      equations[i].moments.noalias() += weight * p * p.transpose();
      for (std::size_t k = 0; k < n_smooth; ++k)
        equations[i].right.col(k) +=
          weight * (values.local_element(n_smooth * j + k) - values.local_element(n_smooth * i + k)) * p;
    };
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        {
          const LocalIndex j       = list.neighbour[slot];
          const bool       of_near = is_wanted[i], of_far = j < families.n_owned() && is_wanted[j];
          if (j == i || !(of_near || of_far) ||
              (is_cut && is_cut(families.position[i], families.position[j])))
            continue;
          if (of_near)
            add(i, j);
          if (of_far)
            add(j, i);
        }
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        if (!is_wanted[i])
          continue;
        // Scaled to a unit diagonal, as fits to few points, all on a line, may be singular.
        QuadraticTerms<dim> scale = equations[i].moments.diagonal();
        for (unsigned int k = 0; k < n_coefficients; ++k)
          scale[k] = scale[k] > 0 ? 1. / std::sqrt(scale[k]) : 0.;
        const Eigen::MatrixXd scaled = scale.asDiagonal() * equations[i].moments * scale.asDiagonal();
        // The coefficients are of lengths over the spacing.
        const QuadraticTerms<dim> unit         = quadratic_terms<dim>([&] {
          dealii::Tensor<1, dim> result;
          for (int d = 0; d < dim; ++d)
            result[d] = 1. / families.spacing[i];
          return result;
        }());
        double                   *coefficients = of_node[i]->data() + first + n_smooth;
        for (std::size_t k = 0; k < n_smooth; ++k)
          {
            const Eigen::VectorXd right    = scale.asDiagonal() * equations[i].right.col(k);
            const Eigen::VectorXd solution = solve_semidefinite(scaled, right, rank_tolerance);
            for (unsigned int c = 0; c < n_coefficients; ++c)
              coefficients[k * n_coefficients + c] = unit[c] * scale[c] * solution[c];
          }
      }
  }

  template <int dim>
  Checkpoint CarriedState<dim>::on(const Body<dim> &body, const CheckpointNodes &nodes) const
  {
    Checkpoint result;
    result.header = state.header;
    result.sums   = state.sums;
    for (const auto &[name, array] : state.node_arrays)
      {
        result.node_arrays[name] = {array.unit, array.width, {}, array.transfer};
        result.node_arrays[name].values.resize(std::size_t(array.width) * nodes.n_owned, 0.);
      }
    for (std::size_t c = 0; c < numbers_of_cell.size(); ++c)
      if (const LocalIndex i = body.nodes->node_of_cell[c]; i != dealii::numbers::invalid_unsigned_int)
        {
          auto from = numbers_of_cell[c].begin() + n_places;
          for (const auto *names : {&constant, &smooth})
            for (const std::string &name : *names)
              {
                NodeArray &array = result.node_arrays.at(name);
                std::copy_n(from, array.width, array.values.begin() + std::size_t(array.width) * i);
                from += array.width;
              }
        }
    std::unordered_map<std::uint64_t, LocalIndex> local;
    for (LocalIndex i = 0; i < nodes.key.size(); ++i)
      local[nodes.key[i]] = i;
    for (const auto &[name, all] : bonds)
      {
        const unsigned int width = state.bond_arrays.at(name).width;
        BondArray         &array = result.bond_arrays[name];
        array.unit               = state.bond_arrays.at(name).unit;
        array.width              = width;
        for (std::size_t b = 0; 2 * b < all.keys.size(); ++b)
          {
            const auto one = local.find(all.keys[2 * b]), other = local.find(all.keys[2 * b + 1]);
            if (one == local.end() || other == local.end() ||
                std::min(one->second, other->second) >= nodes.n_owned)
              continue;
            array.bonds.push_back(
              {std::min(one->second, other->second), std::max(one->second, other->second)});
            array.values.insert(
              array.values.end(), all.values.begin() + width * b, all.values.begin() + width * (b + 1));
          }
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(CarriedState)
} // namespace perideal
