// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/node_partitioner.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

// Set-up of ConsistentOperator and what it reports besides forces.

namespace perideal
{
  template <int dim>
  ConsistentOperator<dim>::ConsistentOperator(const std::shared_ptr<const Families<dim>>     &families,
                                              const std::shared_ptr<const FaceGradient<dim>> &gradient,
                                              const std::shared_ptr<const FaceValues<dim>>   &prescribed,
                                              const Consistent<dim>                          &model,
                                              const SolidOf<dim>                             &solid_of)
    : families(families)
    , gradient(gradient)
    , prescribed(prescribed)
    , model(model)
    , bonds(*families)
  {
    number_nodes();
    set_solids(solid_of);
    weigh_bonds(solid_of);
    for (std::size_t e = 0; e < prescribed->entries().size(); ++e)
      {
        const LocalIndex node  = gradient->boundary_points()[prescribed->entries()[e].point].node;
        auto            &range = prescribed_of_node.insert({node, {e, e}}).first->second;
        AssertDimension(range.second, e);
        range.second = e + 1;
      }
    work.strains.resize(numbering.n_local, PairRecord{});
    work.stresses.resize(numbering.n_local, PairRecord{});
    work.forces.resize(numbering.n_local, NodeRecord{});

    this->reports.resize(numbering.n_owned);
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        this->reports[i].singular = gradient->deficient()[i];
        this->counts.singular += gradient->deficient()[i];
      }
    this->counts.singular = dealii::Utilities::MPI::sum(this->counts.singular, families->communicator);
  }

  template <int dim>
  void ConsistentOperator<dim>::number_nodes()
  {
    const CellGraph<dim> &graph = gradient->graph();
    numbering.n_owned           = graph.n_owned();
    std::map<GlobalIndex, LocalIndex> node_of_number;
    for (LocalIndex i = numbering.n_owned; i < graph.n_local(); ++i)
      node_of_number[graph.global_number(i)] = i;
    numbering.n_local                      = graph.n_local();
    std::vector<dealii::Point<dim>> points = graph.position;
    numbering.node_of_member.resize(families->n_local());
    for (LocalIndex m = 0; m < families->n_local(); ++m)
      if (m < numbering.n_owned)
        numbering.node_of_member[m] = m;
      else
        {
          const auto inserted = node_of_number.insert({families->global_number(m), numbering.n_local});
          if (inserted.second)
            {
              points.push_back(families->position[m]);
              ++numbering.n_local;
            }
          numbering.node_of_member[m] = inserted.first->second;
        }
    numbering.global.resize(numbering.n_local);
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      numbering.global[i] = graph.global_number(i);
    std::vector<GlobalIndex> ghosts;
    for (const auto &ghost : node_of_number)
      {
        numbering.global[ghost.second] = ghost.first;
        ghosts.push_back(ghost.first);
      }

    positions.resize(numbering.n_local, NodeRecord{});
    work.displacements.resize(numbering.n_local, NodeRecord{});
    for (LocalIndex i = 0; i < numbering.n_local; ++i)
      for (int d = 0; d < dim; ++d)
        positions[i].value[d] = points[i][d];

    const GlobalIndex n_global =
      dealii::Utilities::MPI::sum<GlobalIndex>(numbering.n_owned, families->communicator);
    this->partitioner = make_node_partitioner(
      families->global_number(0), numbering.n_owned, n_global, ghosts, dim, families->communicator);
    work.ghosted.reinit(this->partitioner);
    numbering.node_of_ghost = numbering.nodes_of_ghosts(*this->partitioner);
    work.ghosted_strains.reinit(families->make_partitioner(n_pairs));
    const auto force_partitioner = graph.make_partitioner(dim);
    work.ghosted_forces.reinit(force_partitioner);
    numbering.node_of_graph_ghost = numbering.nodes_of_ghosts(*force_partitioner);
  }

  template <int dim>
  std::vector<LocalIndex>
  ConsistentOperator<dim>::Numbering::nodes_of_ghosts(const dealii::Utilities::MPI::Partitioner &layout) const
  {
    std::map<GlobalIndex, LocalIndex> node_of_number;
    for (LocalIndex i = n_owned; i < n_local; ++i)
      node_of_number[global[i]] = i;
    std::vector<LocalIndex> result;
    for (unsigned int g = 0; g < layout.n_ghost_indices(); g += dim)
      result.push_back(node_of_number.at(layout.ghost_indices().nth_index_in_set(g) / dim));
    return result;
  }

  template <int dim>
  void ConsistentOperator<dim>::weigh_bonds(const SolidOf<dim> &solid_of)
  {
    stiffness.near.assign(bonds.n_slots(), 0.);
    stiffness.far.assign(bonds.n_slots(), 0.);
    std::map<dealii::types::material_id, double> modulus_of;
    std::vector<double>                          bond_modulus;
    for (const auto id : families->material)
      {
        if (modulus_of.count(id) == 0)
          modulus_of[id] = Consistent<dim>::stabilising_modulus(solid_of(id));
        bond_modulus.push_back(modulus_of[id]);
      }
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        {
          const LocalIndex j = bonds.neighbour[k];
          if (j == i || families->material[j] != families->material[i])
            continue;
          const auto   bond          = families->position[j] - families->position[i];
          const double length_square = bond.norm_square();
          stiffness.near[k]          = model.bond_stiffness(
            length_square, distance_square(i, bond), families->volume[j], bond_modulus[i]);
          stiffness.far[k] = model.bond_stiffness(
            length_square, distance_square(j, bond), families->volume[i], bond_modulus[j]);
        }
    for (LocalIndex &j : bonds.neighbour)
      j = numbering.node_of_member[j];
  }

  template <int dim>
  void ConsistentOperator<dim>::set_solids(const SolidOf<dim> &solid_of)
  {
    std::map<dealii::types::material_id, LocalIndex> number;
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        const auto inserted = number.insert({families->material[i], solids.size()});
        if (inserted.second)
          {
            const ElasticSolid<dim> from = solid_of(families->material[i]);
            Solid                   solid;
            solid.bond_modulus = Consistent<dim>::stabilising_modulus(from);
            for (unsigned int p = 0; p < n_pairs; ++p)
              for (unsigned int q = 0; q < n_pairs; ++q)
                {
                  const auto [a, b]     = Symmetric::axes(p);
                  const auto [c, d]     = Symmetric::axes(q);
                  solid.stiffness[p][q] = from.stiffness()[a][b][c][d];
                }
            solids.push_back(solid);
          }
        solid_of_node.push_back(inserted.first->second);
      }
  }

  template <int dim>
  std::vector<double> ConsistentOperator<dim>::dilatation() const
  {
    std::vector<double> result(numbering.n_owned, 0.);
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        result[i] += Symmetric::pair(work.strains[i], d);
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> ConsistentOperator<dim>::support_forces() const
  {
    // dU/dv_f = T A_f/V.
    std::vector<dealii::Tensor<1, dim>> result;
    for (const auto &entry : prescribed->entries())
      {
        const BoundaryPoint<dim> &point = gradient->boundary_points()[entry.point];
        dealii::Tensor<1, dim>    force;
        for (unsigned int k = 0; k < n_pairs; ++k)
          {
            const unsigned int a = Symmetric::axes(k).first, b = Symmetric::axes(k).second;
            const double t = Symmetric::pair(work.stresses[point.node], k) / families->volume[point.node];
            force[a] += t * point.area[b];
            if (a != b)
              force[b] += t * point.area[a];
          }
        for (int d = 0; d < dim; ++d)
          if (entry.condition[d] == FaceValues<dim>::free)
            force[d] = 0;
        result.push_back(force);
      }
    return result;
  }

  template <int dim>
  std::size_t ConsistentOperator<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return bonds.memory_consumption() + memory_consumption(stiffness.near) +
           memory_consumption(stiffness.far) + memory_consumption(numbering.node_of_member) +
           memory_consumption(numbering.global) + memory_consumption(solid_of_node) +
           numbering.n_local * (3 * sizeof(NodeRecord) + 2 * sizeof(PairRecord)) +
           gradient->memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
