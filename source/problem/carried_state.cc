// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/carried_softening.h>
#include <perideal/problem/carried_state.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    /// What may become of the cells of owned nodes, by node: a CellFate.
    template <int dim>
    std::vector<double> fates_of_cells(const Checkpoint &state, const LocalIndex n_owned)
    {
      std::vector<double> result(n_owned, CellFate::changes);
      for (const auto &[name, array] : state.bond_arrays)
        for (std::size_t b = 0; b < array.bonds.size(); ++b)
          {
            const bool is_little =
              name == BondMemory::name_of_softened &&
              1. - BondMemory::bond(array.values, b).borne() < CarriedSoftening<dim>::largest_loss;
            for (const LocalIndex end : {array.bonds[b].near, array.bonds[b].far})
              if (end < n_owned)
                result[end] = std::max(result[end], is_little ? CellFate::is_halved : CellFate::stays);
          }
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
    const Nodes<dim> &nodes    = *problem.body.nodes;
    const BondArray   softened = state.bond_arrays[BondMemory::name_of_softened];
    if (dealii::Utilities::MPI::max(softened.bonds.size(), nodes.communicator) > 0)
      state.node_arrays[CarriedSoftening<dim>::name] = CarriedSoftening<dim>::fit(problem, softened);
    for (auto &[name, array] : state.node_arrays)
      {
        // Where only the first nodes have values, or none has, zeros follow.
        array.values.resize(std::size_t(array.width) * nodes.size(), 0.);
        const bool is_smooth = array.transfer == Transfer::smooth;
        (is_smooth ? smooth : constant).push_back(name);
        (is_smooth ? n_smooth : n_constant) += array.width;
      }
    const std::vector<double> costs = cost_of_nodes(problem);
    const auto                fates = fates_of_cells<dim>(state, nodes.size());
    std::vector<Numbers>      of_node(nodes.size());
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        of_node[i] = {fates[i], need.is_quiet[i] ? 1. : 0., costs[i], 0., 0.};
        for (const auto *names : {&constant, &smooth})
          for (const std::string &name : *names)
            {
              const NodeArray &array = state.node_arrays.at(name);
              const auto       first = array.values.begin() + std::size_t(array.width) * i;
              of_node[i].insert(of_node[i].end(), first, first + array.width);
            }
        of_node[i].resize(first_half() + n_smooth * n_halves, 0.);
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
                NodeArray &array   = result.node_arrays.at(name);
                const auto of_node = array.values.begin() + std::size_t(array.width) * i;
                std::copy_n(from, array.width, of_node);
                if (array.transfer == Transfer::marks_halves)
                  *of_node = numbers_of_cell[c][is_half];
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
