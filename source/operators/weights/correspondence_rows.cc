// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/correspondence_rows.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  CorrespondenceRows<dim>::CorrespondenceRows(const std::shared_ptr<const Families<dim>>     &families,
                                              const std::shared_ptr<const FaceGradient<dim>> &gradient,
                                              const std::shared_ptr<const FaceValues<dim>>   &prescribed,
                                              const Correspondence<dim>                      &model,
                                              const SolidOf<dim>                             &solid_of)
    : families(families)
    , gradient(gradient)
    , prescribed(prescribed)
    , model(model)
  {
    of_family.spans_space.assign(families->n_owned(), true);
    for (const auto id : families->material)
      if (penalty_modulus.find(id) == penalty_modulus.end())
        penalty_modulus[id] = Correspondence<dim>::penalty_modulus(solid_of(id));

    FamilyView<dim> view;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      {
        view.reinit(*families, i);
        for (const LocalIndex m : view.member)
          of_family.member.push_back(families->begin(i)[m]);
        of_family.first.push_back(of_family.member.size());
      }
    of_family.c.resize(by_faces() ? 0 : of_family.member.size());
    of_family.penalty.resize(of_family.member.size());
    number_face_ghosts();
    for (LocalIndex i = 0; i < n_owned(); ++i)
      weigh(i, {});
    if (by_faces())
      {
        make_boundary_rows();
        work.support.resize(prescribed->entries().size());
      }
  }

  template <int dim>
  void CorrespondenceRows<dim>::number_face_ghosts()
  {
    const auto own_layout = families->make_partitioner(dim);
    const auto range      = own_layout->local_range();
    // Ghosts of both kinds.
    dealii::IndexSet ghosts(own_layout->size());
    ghosts.add_indices(own_layout->ghost_indices());
    if (by_faces())
      {
        const CellGraph<dim>   &graph = gradient->graph();
        std::vector<LocalIndex> number(graph.n_local());
        for (LocalIndex k = 0; k < graph.n_local(); ++k)
          {
            const GlobalIndex global = graph.global_number(k);
            if (k < graph.n_owned())
              {
                number[k] = k;
                continue;
              }
            const auto known =
              std::lower_bound(families->ghost_number.begin(), families->ghost_number.end(), global);
            if (known != families->ghost_number.end() && *known == global)
              {
                number[k] = n_owned() + (known - families->ghost_number.begin());
                continue;
              }
            number[k] = families->n_local() + of_faces.ghost.size();
            of_faces.ghost.push_back(global);
            ghosts.add_range(dim * global, dim * (global + 1));
          }
        for (const LocalIndex column : gradient->rows().column)
          of_faces.column.push_back(number[column]);
      }
    dealii::IndexSet owned(own_layout->size());
    owned.add_range(range.first, range.second);
    layout =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned, ghosts, families->communicator);
    work.ghosted.reinit(layout);
    work.ghosted_forces.reinit(layout);
    const LocalIndex n = families->n_local() + of_faces.ghost.size();
    for (LocalIndex k = n_owned(); k < n; ++k)
      ghost_number.push_back(layout->global_to_local(dim * global_number(k)));
    positions.resize(n, NodeRecord{});
    work.displacements.resize(n, NodeRecord{});
    work.forces.resize(n, NodeRecord{});
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        positions[i].value[d] = families->position[i][d];
  }

  template <int dim>
  void CorrespondenceRows<dim>::weigh(const LocalIndex                                               i,
                                      const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)
  {
    FamilyView<dim> view;
    view.reinit(*families, i);
    typename Correspondence<dim>::Weights weights;
    const LocalIndex                     *j = of_family.member.data() + of_family.first[i];
    model.compute(
      view,
      penalty_modulus.at(families->material[i]),
      is_gone ? std::function<bool(const LocalIndex)>([&](const LocalIndex k) { return is_gone(i, j[k]); }) :
                nullptr,
      weights);
    of_family.spans_space[i] = weights.has_gradient;
    for (LocalIndex k = 0; k < view.size; ++k)
      {
        // Between materials the faces join, across which gradients jump.
        of_family.penalty[of_family.first[i] + k] =
          by_faces() && families->material[i] != families->material[j[k]] ? 0. : weights.penalty[k];
        if (!by_faces())
          of_family.c[of_family.first[i] + k] = weights.gradient[k];
      }
  }

  template <int dim>
  void
  CorrespondenceRows<dim>::reweigh(const std::vector<LocalIndex>                                 &nodes,
                                   const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)
  {
    for (const LocalIndex i : nodes)
      weigh(i, is_gone);
  }

  template <int dim>
  void CorrespondenceRows<dim>::make_boundary_rows()
  {
    const auto &rows    = gradient->rows();
    const auto &phi     = gradient->boundary_rows();
    const auto &entries = prescribed->entries();
    for (std::size_t e = 0; e < entries.size(); ++e)
      {
        const BoundaryPoint<dim> &point = gradient->boundary_points()[entries[e].point];
        const LocalIndex          i     = point.node;
        const auto begin = rows.column.begin() + rows.first[i], end = rows.column.begin() + rows.first[i + 1];
        const auto inserted = boundary_rows.insert({i, {{}, e, e}});
        BoundaryRow &row    = inserted.first->second;
        if (inserted.second)
          {
            row.c.resize(end - begin);
            for (std::size_t k = 0; k < row.c.size(); ++k)
              for (int a = 0; a < dim; ++a)
                row.c[k][a] = rows.value[rows.first[i] + k];
          }
        Assert(row.last_entry == e, dealii::ExcInternalError());
        row.last_entry = e + 1;
        // The prescribed value takes the place of the interpolated one.
        for (BondIndex k = phi.first[entries[e].point]; k < phi.first[entries[e].point + 1]; ++k)
          {
            const auto at = std::lower_bound(begin, end, phi.column[k]) - begin;
            for (int a = 0; a < dim; ++a)
              if (entries[e].condition[a] != FaceValues<dim>::free)
                row.c[at][a] -= phi.value[k] / families->volume[i] * point.area;
          }
      }
  }

  template <int dim>
  double CorrespondenceRows<dim>::at_face(const std::size_t entry, const int component) const
  {
    const auto &at = prescribed->entries()[entry];
    return work.reading == AtFaces::nothing || at.condition[component] == FaceValues<dim>::free ?
             0. :
             (work.reading == AtFaces::values ? at.value : at.increment)[component];
  }

  template <int dim>
  void
  CorrespondenceRows<dim>::add_at_faces(const BoundaryRow &row, const LocalIndex i, Lanes (&g)[dim]) const
  {
    const LocalIndex *column = of_faces.column.data() + gradient->rows().first[i];
    for (std::size_t k = 0; k < row.c.size(); ++k)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          g[b][a] += work.displacements[column[k]].value[a] * row.c[k][a][b];
    for (std::size_t e = row.first_entry; e < row.last_entry; ++e)
      {
        const auto &area = gradient->boundary_points()[prescribed->entries()[e].point].area;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            g[b][a] += at_face(e, a) * area[b] / families->volume[i];
      }
  }

  template <int dim>
  void CorrespondenceRows<dim>::pull_at_faces(const BoundaryRow &row,
                                              const LocalIndex   i,
                                              const Lanes (&t)[dim]) const
  {
    const LocalIndex *column = of_faces.column.data() + gradient->rows().first[i];
    for (std::size_t k = 0; k < row.c.size(); ++k)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          work.forces[column[k]].value[a] += t[b][a] * row.c[k][a][b];
    for (std::size_t e = row.first_entry; e < row.last_entry; ++e)
      {
        const auto &entry = prescribed->entries()[e];
        const auto &area  = gradient->boundary_points()[entry.point].area;
        work.support[e]   = 0.;
        for (int a = 0; a < dim; ++a)
          if (entry.condition[a] != FaceValues<dim>::free)
            for (int b = 0; b < dim; ++b)
              work.support[e][a] += t[b][a] * area[b] / families->volume[i];
      }
  }

  template <int dim>
  void CorrespondenceRows<dim>::read(const NodalVector &displacement, const AtFaces at_faces) const
  {
    work.reading = at_faces;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        work.displacements[i].value[d] = displacement.local_element(dim * i + d);
    if (ghost_number.empty() && layout->n_import_indices() == 0)
      return;
    std::copy_n(displacement.begin(), dim * n_owned(), work.ghosted.begin());
    work.ghosted.update_ghost_values();
    for (std::size_t g = 0; g < ghost_number.size(); ++g)
      for (int d = 0; d < dim; ++d)
        work.displacements[n_owned() + g].value[d] = work.ghosted.local_element(ghost_number[g] + d);
    work.ghosted.zero_out_ghost_values();
  }

  template <int dim>
  void CorrespondenceRows<dim>::collect(NodalVector &force) const
  {
    NodalVector &sum = ghost_number.empty() && layout->n_import_indices() == 0 ? force : work.ghosted_forces;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        sum.local_element(dim * i + d) = work.forces[i].value[d];
    if (&sum == &force)
      return;
    for (std::size_t g = 0; g < ghost_number.size(); ++g)
      for (int d = 0; d < dim; ++d)
        sum.local_element(ghost_number[g] + d) = work.forces[n_owned() + g].value[d];
    sum.compress(dealii::VectorOperation::add);
    std::copy_n(sum.begin(), dim * n_owned(), force.begin());
  }

  template <int dim>
  double CorrespondenceRows<dim>::penalty_energy(const LocalIndex i, const Gradient &g) const
  {
    double result = 0;
    for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
      {
        dealii::Tensor<1, dim> z, bond;
        for (int d = 0; d < dim; ++d)
          {
            bond[d] = positions[of_family.member[k]].value[d] - positions[i].value[d];
            z[d]    = work.displacements[of_family.member[k]].value[d] - work.displacements[i].value[d];
          }
        result += 0.5 * of_family.penalty[k] * (z - g * bond).norm_square();
      }
    return result;
  }

  template <int dim>
  std::size_t CorrespondenceRows<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(of_family.first) + memory_consumption(of_family.member) +
           memory_consumption(of_family.c) + memory_consumption(of_family.penalty) +
           memory_consumption(of_faces.column) + (gradient ? gradient->memory_consumption() : 0) +
           3 * positions.size() * sizeof(NodeRecord) + work.ghosted.memory_consumption() +
           work.ghosted_forces.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(CorrespondenceRows)
} // namespace perideal
