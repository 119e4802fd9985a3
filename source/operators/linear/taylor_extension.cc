// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/polynomial_response.h>
#include <perideal/operators/linear/taylor_extension.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  template <typename MapOfCoefficients>
  void TaylorExtension<dim>::Rows::add(const MapOfCoefficients &map, const TaylorPolynomial<dim> &polynomial)
  {
    const Eigen::Matrix<double, dim, Eigen::Dynamic> nodes = map * polynomial.of_nodes,
                                                     loads = map * polynomial.of_known;
    rows.push_back({polynomial.nodes.front(), column.size(), known.size()});
    for (std::size_t m = 0; m < polynomial.nodes.size(); ++m)
      {
        dealii::Tensor<2, dim> entry;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            entry[a][b] = nodes(a, dim * m + b);
        column.push_back(polynomial.nodes[m]);
        block.push_back(entry);
      }
    for (std::size_t k = 0; k < polynomial.known.size(); ++k)
      {
        dealii::Tensor<1, dim> entry;
        for (int a = 0; a < dim; ++a)
          entry[a] = loads(a, k);
        known.push_back(polynomial.known[k]);
        of_known.push_back(entry);
      }
  }

  template <int dim>
  dealii::Tensor<1, dim> TaylorExtension<dim>::Rows::of_nodes(const std::size_t  r,
                                                              const NodalVector &ghosted) const
  {
    dealii::Tensor<1, dim> result;
    for (std::size_t m = rows[r].first_node; m < end_node(r); ++m)
      {
        dealii::Tensor<1, dim> u;
        for (int d = 0; d < dim; ++d)
          u[d] = ghosted.local_element(dim * column[m] + d);
        result += block[m] * u;
      }
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  TaylorExtension<dim>::Rows::of_loads(const std::size_t r, const Loads<dim> &loads, const double time) const
  {
    dealii::Tensor<1, dim> result;
    for (std::size_t k = rows[r].first_known; k < end_known(r); ++k)
      result += known[k].at(loads, time) * of_known[k];
    return result;
  }

  template <int dim>
  std::size_t TaylorExtension<dim>::Rows::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return rows.size() * sizeof(Row) + memory_consumption(column) + memory_consumption(block) +
           known.size() * sizeof(SurfaceValue<dim>) + memory_consumption(of_known);
  }

  template <int dim>
  TaylorExtension<dim>::TaylorExtension(const std::shared_ptr<const BondOperator<dim>> &bonds,
                                        const std::shared_ptr<const Families<dim>>     &families,
                                        const NodeCloud<dim>                           &nodes,
                                        const std::vector<BoundaryFace<dim>>           &faces,
                                        const std::vector<SurfaceFace<dim>>            &surface,
                                        const Loads<dim>                               &loads,
                                        const dealii::SymmetricTensor<4, dim>          &stiffness)
    : bonds(bonds)
    , families(families)
    , ghosted(families->make_partitioner(dim))
  {
    this->counts  = bonds->counts;
    this->reports = bonds->reports;
    // Rows reach to the nodes of the bonds and of families.
    NodalVector layout;
    bonds->initialize(layout);
    dealii::IndexSet reached = layout.get_partitioner()->ghost_indices();
    reached.add_indices(ghosted.get_partitioner()->ghost_indices());
    this->partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      layout.locally_owned_elements(), reached, families->communicator);

    std::vector<NearFaces>    near;
    std::vector<std::uint8_t> is_inside;
    find_near_faces(nodes, faces, surface, near, is_inside);
    std::vector<std::vector<const BoundaryFace<dim> *>> loaded(nodes.size());
    for (const BoundaryFace<dim> &face : faces)
      if (std::any_of(loads.conditions.begin(), loads.conditions.end(), [&](const auto &condition) {
            return condition.acts_on(face.boundary);
          }))
        loaded[face.node].push_back(&face);

    const PolynomialResponse<dim> response(*bonds, *families);
    stiffness_of_bonds = response.stiffness(is_inside).value_or(stiffness);
    const TaylorFit<dim> fit(*families, loads, stiffness_of_bonds);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        if (!response.lacks_bonds(i))
          continue;
        const auto polynomial = is_inside[i] ? fit.fit_inside(i) : fit.fit(i, near[i]);
        auto       missing    = response.force_of_gradient(i);
        if (!is_inside[i])
          missing = response.force(i) +
                    response.divergence(stiffness_of_bonds, families->volume[i], families->spacing[i]);
        ghosts.add(missing, polynomial);
        for (const BoundaryFace<dim> *face : loaded[i])
          add_face(*face, polynomial);
      }
  }

  template <int dim>
  void TaylorExtension<dim>::find_near_faces(const NodeCloud<dim>                 &nodes,
                                             const std::vector<BoundaryFace<dim>> &faces,
                                             const std::vector<SurfaceFace<dim>>  &surface,
                                             std::vector<NearFaces>               &near,
                                             std::vector<std::uint8_t>            &is_inside) const
  {
    std::vector<std::vector<dealii::Point<dim>>> own(nodes.size());
    for (const BoundaryFace<dim> &face : faces)
      own[face.node].push_back(face.centre);
    near.resize(nodes.size());
    is_inside.resize(nodes.size());
    visit_nearby_faces<dim>(
      nodes,
      surface,
      [&](const LocalIndex i, const std::vector<const SurfaceFace<dim> *> &reached) {
        is_inside[i] = reached.empty();
        for (const auto *face : reached)
          {
            const dealii::Tensor<1, dim> way = face->centre - nodes.position[i];
            if (way * face->normal > 0 && way.norm() <= nodes.horizon[i] + face->radius)
              near[i].emplace_back(face, std::any_of(own[i].begin(), own[i].end(), [&](const auto &centre) {
                                     return centre.distance(face->centre) < 1e-9 * nodes.spacing[i];
                                   }));
          }
      },
      2.);
  }

  template <int dim>
  void TaylorExtension<dim>::add_face(const BoundaryFace<dim> &face, const TaylorPolynomial<dim> &polynomial)
  {
    const LocalIndex i       = polynomial.nodes.front();
    const double     spacing = families->spacing[i];
    for (const FacePoint<dim> &point : quadrature_points<dim>(face))
      {
        typename PolynomialResponse<dim>::Map traction;
        for (unsigned int c = 0; c < dim; ++c)
          traction.row(c) =
            TaylorBasis<dim>::traction(
              (point.position - families->position[i]) / spacing, stiffness_of_bonds, point.normal, c) /
            spacing;
        tractions.add(traction, polynomial);
        points.push_back({face.boundary, point, {}});
      }
  }

  template <int dim>
  void TaylorExtension<dim>::import(const NodalVector &displacement) const
  {
    ghosted.zero_out_ghost_values();
    std::copy(displacement.begin(), displacement.begin() + dim * families->n_owned(), ghosted.begin());
    ghosted.update_ghost_values();
  }

  template <int dim>
  void TaylorExtension<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    bonds->vmult(force, displacement);
    import(displacement);
    for (std::size_t r = 0; r < ghosts.rows.size(); ++r)
      {
        const auto missing = ghosts.of_nodes(r, ghosted);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * ghosts.rows[r].node + d) -= missing[d];
      }
  }

  template <int dim>
  void TaylorExtension<dim>::add_known(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    for (std::size_t r = 0; r < ghosts.rows.size(); ++r)
      {
        const auto missing = ghosts.of_loads(r, loads, time);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * ghosts.rows[r].node + d) += missing[d];
      }
  }

  template <int dim>
  std::vector<typename TaylorExtension<dim>::FaceTraction> TaylorExtension<dim>::face_tractions(
    const NodalVector &displacement, const Loads<dim> &loads, const double time) const
  {
    import(displacement);
    auto result = points;
    for (std::size_t r = 0; r < result.size(); ++r)
      result[r].traction = tractions.of_nodes(r, ghosted) + tractions.of_loads(r, loads, time);
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> TaylorExtension<dim>::jacobi_blocks() const
  {
    auto result = bonds->jacobi_blocks();
    // The node itself is the first of its row.
    for (const auto &row : ghosts.rows)
      result[row.node] -= ghosts.block[row.first_node];
    return result;
  }

  template <int dim>
  void TaylorExtension<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    bonds->assemble(add);
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    for (std::size_t r = 0; r < ghosts.rows.size(); ++r)
      {
        // The rows of the node alone, the first ones.
        const std::size_t first = ghosts.rows[r].first_node, n_nodes = ghosts.end_node(r) - first;
        unknowns.resize(dim * n_nodes);
        values.assign(dim * n_nodes * dim * n_nodes, 0.);
        for (std::size_t m = 0; m < n_nodes; ++m)
          for (int b = 0; b < dim; ++b)
            {
              unknowns[dim * m + b] = dim * families->global_number(ghosts.column[first + m]) + b;
              for (int a = 0; a < dim; ++a)
                values[a * dim * n_nodes + dim * m + b] = -ghosts.block[first + m][a][b];
            }
        add(unknowns, values);
      }
  }

  template <int dim>
  std::size_t TaylorExtension<dim>::memory_consumption() const
  {
    return bonds->memory_consumption() + ghosts.memory_consumption() + tractions.memory_consumption() +
           points.size() * sizeof(points[0]) + ghosted.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(TaylorExtension)
} // namespace perideal
