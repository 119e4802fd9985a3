// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <algorithm>

// The hot loops of ConsistentOperator: gradient rows, bonds, gradient rows transposed.

namespace perideal
{
  namespace
  {
    /// xi (x) xi of a bond, as in a PairRecord.
    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 1> &products)
    {
      products[0] =
        __builtin_shufflevector(bond, bond, 0, 1, 0, 3) * __builtin_shufflevector(bond, bond, 0, 1, 1, 3);
    }

    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 2> &products)
    {
      products[0] = bond * bond;
      products[1] = bond * __builtin_shufflevector(bond, bond, 1, 2, 0, 3);
    }
  } // namespace

  template <int dim>
  void ConsistentOperator<dim>::import_displacement(const NodalVector &displacement) const
  {
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      for (int d = 0; d < dim; ++d)
        work.displacements[i].value[d] = displacement.local_element(dim * i + d);
    if (numbering.n_local == numbering.n_owned)
      return;
    std::copy(displacement.begin(), displacement.begin() + dim * numbering.n_owned, work.ghosted.begin());
    work.ghosted.update_ghost_values();
    for (std::size_t g = 0; g < numbering.node_of_ghost.size(); ++g)
      for (int d = 0; d < dim; ++d)
        work.displacements[numbering.node_of_ghost[g]].value[d] =
          work.ghosted.local_element(dim * (numbering.n_owned + g) + d);
    work.ghosted.zero_out_ghost_values();
  }

  template <int dim>
  void ConsistentOperator<dim>::compute_strains(const bool with_prescribed) const
  {
    const auto &rows = gradient->rows();
    auto        next = prescribed_of_node.begin();
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        dealii::Tensor<2, dim> g;
        for (BondIndex k = rows.first[i]; k < rows.first[i + 1]; ++k)
          {
            const double *u = work.displacements[rows.column[k]].value;
            for (int a = 0; a < dim; ++a)
              for (int b = 0; b < dim; ++b)
                g[a][b] += u[a] * rows.value[k][b];
          }
        if (next != prescribed_of_node.end() && next->first == i)
          {
            replace_face_values(next->second, with_prescribed, g);
            ++next;
          }
        for (unsigned int k = 0; k < n_pairs; ++k)
          {
            const auto [a, b]                   = Symmetric::axes(k);
            Symmetric::pair(work.strains[i], k) = a == b ? g[a][a] : g[a][b] + g[b][a];
          }
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::replace_face_values(const EntryRange       &range,
                                                    const bool              with_prescribed,
                                                    dealii::Tensor<2, dim> &g) const
  {
    const auto &phi = gradient->boundary_rows();
    for (std::size_t e = range.first; e < range.second; ++e)
      {
        const auto               &entry = prescribed->entries()[e];
        const BoundaryPoint<dim> &point = gradient->boundary_points()[entry.point];
        const auto                area  = point.area / families->volume[point.node];
        for (int a = 0; a < dim; ++a)
          if (entry.condition[a] != FaceValues<dim>::free)
            {
              double change = with_prescribed ? entry.value[a] : 0.;
              for (BondIndex k = phi.first[entry.point]; k < phi.first[entry.point + 1]; ++k)
                change -= phi.value[k] * work.displacements[phi.column[k]].value[a];
              g[a] += change * area;
            }
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::import_strains() const
  {
    if (families->n_local() == numbering.n_owned)
      return;
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      for (unsigned int k = 0; k < n_pairs; ++k)
        work.ghosted_strains.local_element(n_pairs * i + k) = Symmetric::pair(work.strains[i], k);
    work.ghosted_strains.update_ghost_values();
    for (LocalIndex m = numbering.n_owned; m < families->n_local(); ++m)
      for (unsigned int k = 0; k < n_pairs; ++k)
        Symmetric::pair(work.strains[numbering.node_of_member[m]], k) =
          work.ghosted_strains.local_element(n_pairs * m + k);
    work.ghosted_strains.zero_out_ghost_values();
  }

  template <int dim>
  void ConsistentOperator<dim>::sum_over_bonds() const
  {
    using Parts                    = std::array<Lanes, n_parts>;
    constexpr unsigned int n_lanes = BondList::n_lanes;
    const NodeRecord      *x = positions.data(), *u = work.displacements.data();
    const PairRecord      *strain = work.strains.data();
    NodeRecord            *f      = work.forces.data();
    PairRecord            *stress = work.stresses.data();
    std::fill(work.forces.begin(), work.forces.end(), NodeRecord{});
    std::fill(work.stresses.begin(), work.stresses.end(), PairRecord{});

    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        const Lanes xi = lanes(x[i]), ui    = lanes(u[i]);
        Parts       near_strain, own_stress = {};
        for (unsigned int p = 0; p < n_parts; ++p)
          near_strain[p] = lanes(strain[i][p]);
        Lanes own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += n_lanes)
          {
            const LocalIndex *j = bonds.neighbour.data() + k;
            Lanes             bond[n_lanes], near[n_lanes], far[n_lanes];
            Parts             square[n_lanes];
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                bond[l] = lanes(x[j[l]]) - xi;
                multiply_out(bond[l], square[l]);
                near[l] = far[l] = bond[l] * (lanes(u[j[l]]) - ui);
                for (unsigned int p = 0; p < n_parts; ++p)
                  {
                    near[l] -= near_strain[p] * square[l][p];
                    far[l] -= lanes(strain[j[l]][p]) * square[l][p];
                  }
              }
            Lanes near_pull, far_pull, near_stiffness, far_stiffness;
            sum_of_each(near_pull, near[0], near[1], near[2], near[3]);
            sum_of_each(far_pull, far[0], far[1], far[2], far[3]);
            load(near_stiffness, stiffness.near.data() + k);
            load(far_stiffness, stiffness.far.data() + k);
            near_pull *= near_stiffness;
            far_pull *= far_stiffness;
            const Lanes pull = near_pull + far_pull;
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                const Lanes force = pull[l] * bond[l];
                own += force;
                lanes(f[j[l]]) -= force;
                for (unsigned int p = 0; p < n_parts; ++p)
                  {
                    own_stress[p] -= near_pull[l] * square[l][p];
                    lanes(stress[j[l]][p]) -= far_pull[l] * square[l][p];
                  }
              }
          }
        lanes(f[i]) += own;
        for (unsigned int p = 0; p < n_parts; ++p)
          lanes(stress[i][p]) += own_stress[p];
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::turn_into_stress() const
  {
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        const auto  &stiffness = solids[solid_of_node[i]].stiffness;
        const double volume    = families->volume[i];
        for (unsigned int p = 0; p < n_pairs; ++p)
          {
            double stress = 0;
            for (unsigned int q = 0; q < n_pairs; ++q)
              stress += stiffness[p][q] * Symmetric::pair(work.strains[i], q);
            Symmetric::pair(work.stresses[i], p) += volume * stress;
          }
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::add_transposed_gradient() const
  {
    const auto &rows = gradient->rows();
    const auto &phi  = gradient->boundary_rows();
    auto        next = prescribed_of_node.begin();
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      {
        dealii::Tensor<2, dim> t;
        for (unsigned int k = 0; k < n_pairs; ++k)
          {
            const auto [a, b] = Symmetric::axes(k);
            t[a][b] = t[b][a] = Symmetric::pair(work.stresses[i], k);
          }
        for (BondIndex k = rows.first[i]; k < rows.first[i + 1]; ++k)
          {
            double *f = work.forces[rows.column[k]].value;
            for (int a = 0; a < dim; ++a)
              f[a] -= t[a] * rows.value[k];
          }
        if (next == prescribed_of_node.end() || next->first != i)
          continue;
        for (std::size_t e = next->second.first; e < next->second.second; ++e)
          {
            const auto &entry = prescribed->entries()[e];
            const auto  pull  = t * gradient->boundary_points()[entry.point].area / families->volume[i];
            for (int a = 0; a < dim; ++a)
              if (entry.condition[a] != FaceValues<dim>::free)
                for (BondIndex k = phi.first[entry.point]; k < phi.first[entry.point + 1]; ++k)
                  work.forces[phi.column[k]].value[a] += phi.value[k] * pull[a];
          }
        ++next;
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::apply(NodalVector       &force,
                                      const NodalVector &displacement,
                                      const bool         with_prescribed) const
  {
    import_displacement(displacement);
    compute_strains(with_prescribed);
    import_strains();
    sum_over_bonds();
    turn_into_stress();
    // What the bonds did to ghosts, their owners know themselves.
    std::fill(work.forces.begin() + numbering.n_owned, work.forces.end(), NodeRecord{});
    add_transposed_gradient();
    // Bonds pull node i along +xi when stretched; K u resists with the opposite sign.
    for (LocalIndex i = 0; i < numbering.n_owned; ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = -work.forces[i].value[d];
    if (numbering.node_of_graph_ghost.empty() &&
        work.ghosted_forces.get_partitioner()->n_import_indices() == 0)
      return;
    for (std::size_t i = 0; i < dim * numbering.n_owned; ++i)
      work.ghosted_forces.local_element(i) = force.local_element(i);
    for (std::size_t g = 0; g < numbering.node_of_graph_ghost.size(); ++g)
      for (int d = 0; d < dim; ++d)
        work.ghosted_forces.local_element(dim * (numbering.n_owned + g) + d) =
          -work.forces[numbering.node_of_graph_ghost[g]].value[d];
    work.ghosted_forces.compress(dealii::VectorOperation::add);
    for (std::size_t i = 0; i < dim * numbering.n_owned; ++i)
      force.local_element(i) = work.ghosted_forces.local_element(i);
  }

  template <int dim>
  void ConsistentOperator<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    apply(force, displacement, false);
  }

  template <int dim>
  void ConsistentOperator<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    apply(force, displacement, true);
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
