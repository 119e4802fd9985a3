// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/equal_records.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/body_forces.h>
#include <perideal/nodes/node_partitioner.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

// Set-up of GradientMoments, and what is not called in every application of an operator.

namespace perideal
{
  namespace
  {
    /// What the loops read of a face of a grid along the axes; no axis where it is none.
    /// @param rounding what coordinates are off by [m]
    template <int dim>
    AlignedFace<dim>
    align(const typename FaceMoments<dim>::Shape &shape, const double *moments, const double rounding)
    {
      using M = Monomials<dim>;
      AlignedFace<dim> result;
      if (!shape.is_plane)
        return result;
      const double *normal = moments, *moment = moments + dim;
      unsigned int  axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) > std::abs(normal[axis]))
          axis = d;
      double size = std::abs(shape.offset[0][axis]);
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          size = std::max(size, std::sqrt(moment[1 + dim + d] / moment[0]));
      const double tolerance = 1e-13 + rounding / size;
      result.area            = normal[axis] * moment[0];
      std::array<double, M::n> rest;
      std::copy_n(moment, M::n, rest.begin());
      rest[0]       = 0.;
      bool is_found = true;
      for (unsigned int j = 0; j < dim - 1; ++j)
        {
          const unsigned int other = (axis + 1 + j) % dim;
          result.square[j]         = normal[axis] * moment[1 + dim + other];
          rest[1 + dim + other]    = 0.;
          is_found                 = is_found && std::abs(normal[other]) <= tolerance;
          for (const auto &offset : shape.offset)
            is_found = is_found && std::abs(offset[other]) <= tolerance * size;
        }
      for (unsigned int m = 0; m < M::n; ++m)
        is_found = is_found && std::abs(rest[m]) <= tolerance * moment[0] * std::pow(size, M::degree(m));
      for (unsigned int s = 0; s < 2; ++s)
        result.offset[s] = shape.offset[s][axis];
      if (is_found)
        result.axis = axis;
      return result;
    }
  } // namespace

  template <int dim>
  GradientMoments<dim>::GradientMoments(const std::shared_ptr<const CellPolynomials<dim>> &polynomials,
                                        const std::shared_ptr<const FaceMoments<dim>>     &face_moments,
                                        const std::shared_ptr<const FaceValues<dim>>      &prescribed,
                                        MPI_Comm                                           communicator)
    : polynomials(polynomials)
    , face_moments(face_moments)
    , prescribed(prescribed)
    , n_owned_cells(polynomials->graph().n_owned())
  {
    number(communicator);
    const double rounding = coordinate_rounding(polynomials->centroids());
    for (const Shape &shape : face_moments->shapes())
      aligned.push_back(align<dim>(shape, face_moments->moments_of(shape), rounding));
    collect_held();
    work.gradient.resize(dim * n_owned_cells, NodeRecord{});
    work.moment.resize(dim * dim * n_owned_cells, NodeRecord{});
    work.value_force.resize(n_owned_cells, NodeRecord{});
    work.trace_force.resize(n_owned_cells, NodeRecord{});
  }

  template <int dim>
  void GradientMoments<dim>::number(MPI_Comm communicator)
  {
    const CellGraph<dim> &graph = polynomials->graph();
    const GlobalIndex     n_all = dealii::Utilities::MPI::sum<GlobalIndex>(n_owned_cells, communicator);
    // A rank may have no cells.
    const GlobalIndex own_first = n_owned_cells > 0 ? graph.global_number(0) : 0;
    of_displacements            = graph.make_partitioner(4);

    // In the order of the graph, which is that of layouts.
    std::set<LocalIndex> beyond;
    for (const Face &face : face_moments->faces())
      for (const LocalIndex node : face.node)
        if (node != FaceMoments<dim>::none && node >= n_owned_cells)
          beyond.insert(node);
    std::vector<GlobalIndex> numbers;
    polynomial_of_ghost.assign(graph.n_local() - n_owned_cells, FaceMoments<dim>::none);
    for (const LocalIndex node : beyond)
      {
        polynomial_of_ghost[node - n_owned_cells] = n_owned_cells + numbers.size();
        numbers.push_back(graph.global_number(node));
      }
    of_polynomials =
      make_node_partitioner(own_first, n_owned_cells, n_all, numbers, 4 * n_coefficients, communicator);

    work.displacement.resize(graph.n_local(), NodeRecord{});
    work.polynomial.resize(n_coefficients * (n_owned_cells + numbers.size()), NodeRecord{});
  }

  template <int dim>
  void GradientMoments<dim>::collect_held()
  {
    const auto &entries = prescribed->entries();
    for (std::size_t e = 0; e < entries.size(); e += FaceMoments<dim>::n_points)
      {
        Held of_face{Lanes{}, Lanes{}, e};
        for (int d = 0; d < dim; ++d)
          {
            of_face.normal[d] = entries[e].normal[d];
            if (entries[e].condition[d] != FaceValues<dim>::free)
              of_face.mask[d] = 1.;
          }
        held[face_moments->first_boundary_face() + face_moments->boundary_points()[entries[e].point].face] =
          of_face;
      }
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> GradientMoments<dim>::support_forces(const CellSubset *some) const
  {
    // dU/du at the points of a face, of which V G_l and H_kl have the sums n_l u and n_l (x - x_i)_k u.
    const auto                         &points  = face_moments->boundary_points();
    const auto                         &entries = prescribed->entries();
    std::vector<dealii::Tensor<1, dim>> result(entries.size());
    const LoopOver<std::size_t>         loop(some ? &some->entries : nullptr, entries.size());
    for (std::size_t n = 0; n < loop.size(); ++n)
      {
        const auto               &entry  = entries[loop[n]];
        const BoundaryPoint<dim> &point  = points[entry.point];
        const LocalIndex          i      = point.node;
        const auto                arm    = point.point - polynomials->centroids()[i];
        const bool                slides = entry.sliding_condition != FaceValues<dim>::free;
        dealii::Tensor<1, dim>    force;
        for (int a = 0; a < dim; ++a)
          if (slides || entry.condition[a] != FaceValues<dim>::free)
            for (int l = 0; l < dim; ++l)
              {
                double pull = gradient(i)[l].value[a];
                for (int k = 0; k < dim; ++k)
                  pull += arm[k] * moment(i)[dim * k + l].value[a];
                force[a] += pull * point.area[l];
              }
        result[loop[n]] = slides ? (force * entry.normal) * entry.normal : force;
      }
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> GradientMoments<dim>::add_body_forces(const Mesh<dim>  &mesh,
                                                                            const Nodes<dim> &nodes,
                                                                            const Loads<dim> &loads,
                                                                            const double      time,
                                                                            NodalVector      &force) const
  {
    const auto integrals = integrate_body_forces(mesh, nodes, polynomials->centroids(), loads, time);
    for (LocalIndex i = 0; i < n_owned_cells; ++i)
      for (int a = 0; a < dim; ++a)
        {
          const double volume = polynomials->volumes()[i];
          // V w is 1/dim of the trace of H by faces less that by the polynomial.
          const double on_trace        = integrals[i].force[a] / (dim * volume);
          work.value_force[i].value[a] = 0.;
          work.trace_force[i].value[a] = -on_trace;
          for (int l = 0; l < dim; ++l)
            {
              gradient(i)[l].value[a] = integrals[i].moment[a][l] / volume;
              for (int k = 0; k < dim; ++k)
                moment(i)[dim * k + l].value[a] = k == l ? on_trace : 0.;
            }
        }
    spread_to_faces(nullptr);
    NodalVector sum(force);
    spread_to_nodes(sum, nullptr);
    for (std::size_t r = 0; r < dim * static_cast<std::size_t>(n_owned_cells); ++r)
      force.local_element(r) += sum.local_element(r);
    return support_forces();
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> GradientMoments<dim>::values_at(const std::vector<Place> &places,
                                                                      const NodalVector &displacement) const
  {
    read_polynomials(displacement);
    std::vector<dealii::Tensor<1, dim>>   result;
    std::array<double, Monomials<dim>::n> monomial;
    for (const auto &[cell, point] : places)
      {
        Monomials<dim>::evaluate(point - polynomials->centroids()[cell], monomial);
        result.emplace_back();
        for (unsigned int m = 0; m < n_coefficients; ++m)
          for (int a = 0; a < dim; ++a)
            result.back()[a] += monomial[m] * work.polynomial[n_coefficients * cell + m].value[a];
      }
    return result;
  }

  template <int dim>
  std::size_t GradientMoments<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return polynomials->memory_consumption() + face_moments->memory_consumption() +
           aligned.size() * sizeof(AlignedFace<dim>) +
           (work.displacement.size() + work.polynomial.size() + work.gradient.size() + work.moment.size() +
            work.value_force.size() + work.trace_force.size()) *
             sizeof(NodeRecord);
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientMoments)
} // namespace perideal
