// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <algorithm>
#include <array>
#include <type_traits>

// The hot loops of GradientMoments over faces, and their transposes.

namespace perideal
{
  namespace
  {
    /// Faces between the one that is summed and that whose cells are asked for: the second cell of a face
    /// lies anywhere in memory.
    constexpr std::size_t n_ahead = 4;

    PERIDEAL_INLINE void prefetch(const NodeRecord *records, const unsigned int n)
    {
      for (unsigned int k = 0; k < n; k += 2)
        __builtin_prefetch(records + k);
    }

    template <int dim, typename Work>
    PERIDEAL_INLINE void prefetch_cell(const Work &work, const LocalIndex i)
    {
      constexpr unsigned int n = Monomials<dim>::n_coefficients;
      prefetch(work.polynomial.data() + n * i, n);
      prefetch(work.gradient.data() + dim * i, dim);
      prefetch(work.moment.data() + dim * dim * i, dim * dim);
    }

    /// Calls act with the axis of an aligned face as a constant.
    template <int dim, typename Act>
    PERIDEAL_INLINE void with_axis(const unsigned int axis, const Act &act)
    {
      if (axis == 0)
        act(std::integral_constant<unsigned int, 0>());
      else if (axis == 1)
        act(std::integral_constant<unsigned int, 1>());
      else
        act(std::integral_constant<unsigned int, dim - 1>());
    }

    /// Takes what is prescribed out of what a face gives.
    template <int dim, typename Held>
    void take_free_part(const Held &face, FaceSums<dim> &sums)
    {
      for (unsigned int l = 0; l < dim; ++l)
        {
          sums.gradient[l] = face.free_part(sums.gradient[l]);
          for (unsigned int k = 0; k < dim; ++k)
            sums.moment[k][l] = face.free_part(sums.moment[k][l]);
        }
    }

    /// The places of the polynomials of a face's cells.
    using Cells = std::array<LocalIndex, 2>;

    /// Adds what an aligned inner face gives to gradients and moments.
    template <int dim, unsigned int axis, typename Work>
    PERIDEAL_INLINE void sum_over_aligned(Work                        &work,
                                          const LocalIndex             n_owned,
                                          const Cells                 &cell,
                                          const std::array<double, 2> &share,
                                          const AlignedFace<dim>      &aligned)
    {
      AlignedPolynomial<dim> polynomial;
      for (unsigned int side = 0; side < 2; ++side)
        add_along<dim, axis>(work.polynomial.data() + Monomials<dim>::n_coefficients * cell[side],
                             aligned.offset[side],
                             share[side],
                             polynomial);
      Lanes total = aligned.area * polynomial.value, first[dim - 1];
      for (unsigned int j = 0; j < dim - 1; ++j)
        {
          total += aligned.square[j] * polynomial.square[j];
          first[j] = aligned.square[j] * polynomial.slope[j];
        }
      for (unsigned int side = 0; side < 2; ++side)
        if (const LocalIndex i = cell[side]; i < n_owned)
          {
            const double sign = side == 0 ? 1. : -1.;
            NodeRecord  *h    = work.moment.data() + dim * dim * i + axis;
            lanes(work.gradient[dim * i + axis]) += sign * total;
            lanes(h[dim * axis]) += (sign * aligned.offset[side]) * total;
            for (unsigned int j = 0; j < dim - 1; ++j)
              lanes(h[dim * ((axis + 1 + j) % dim)]) += sign * first[j];
          }
    }

    /// Its transpose: adds what acts on them to what acts on polynomials.
    template <int dim, unsigned int axis, typename Work>
    PERIDEAL_INLINE void spread_to_aligned(Work                        &work,
                                           const LocalIndex             n_owned,
                                           const Cells                 &cell,
                                           const std::array<double, 2> &share,
                                           const AlignedFace<dim>      &aligned)
    {
      Lanes pull = {}, first[dim - 1] = {};
      for (unsigned int side = 0; side < 2; ++side)
        if (const LocalIndex i = cell[side]; i < n_owned)
          {
            const double      sign = side == 0 ? 1. : -1.;
            const NodeRecord *h    = work.moment.data() + dim * dim * i + axis;
            pull +=
              sign * (lanes(work.gradient[dim * i + axis]) + aligned.offset[side] * lanes(h[dim * axis]));
            for (unsigned int j = 0; j < dim - 1; ++j)
              first[j] += sign * lanes(h[dim * ((axis + 1 + j) % dim)]);
          }
      AlignedPolynomial<dim> polynomial;
      polynomial.value = aligned.area * pull;
      for (unsigned int j = 0; j < dim - 1; ++j)
        {
          polynomial.square[j] = aligned.square[j] * pull;
          polynomial.slope[j]  = aligned.square[j] * first[j];
        }
      for (unsigned int side = 0; side < 2; ++side)
        add_along_back<dim, axis>(polynomial,
                                  aligned.offset[side],
                                  share[side],
                                  work.polynomial.data() + Monomials<dim>::n_coefficients * cell[side]);
    }
  } // namespace

  template <int dim>
  template <typename AlongAxis, typename Any>
  PERIDEAL_INLINE void
  GradientMoments<dim>::visit_faces(const CellSubset *some, const AlongAxis &along_axis, const Any &any) const
  {
    const auto                 &faces         = face_moments->faces();
    const std::size_t           n_inner_faces = face_moments->n_inner_faces();
    auto                        next          = held.begin();
    const LoopOver<std::size_t> loop(some ? &some->faces : nullptr, faces.size());
    for (std::size_t n = 0; n < loop.size(); ++n)
      {
        const std::size_t f = loop[n];
        while (next != held.end() && next->first < f)
          ++next;
        if (f + n_ahead < n_inner_faces)
          prefetch_cell<dim>(work, cells_of(faces[f + n_ahead], true)[1]);
        const Shape &shape    = face_moments->shape_of(faces[f]);
        const bool   is_inner = f < n_inner_faces;
        const Cells  cells    = cells_of(faces[f], is_inner);
        if (const auto &along = aligned[faces[f].shape]; is_inner && along.axis != AlignedFace<dim>::none)
          with_axis<dim>(along.axis, [&](const auto axis) { along_axis(axis, shape, along, cells); });
        else
          any(shape,
              cells,
              is_inner ? 2u : 1u,
              next != held.end() && next->first == f ? &next->second : nullptr);
      }
  }

  template <int dim>
  void GradientMoments<dim>::sum_over_faces(const AtFaces at_faces, const CellSubset *some) const
  {
    const auto clear = [&](const std::vector<LocalIndex> &cells) {
      for (const LocalIndex i : cells)
        {
          std::fill_n(gradient(i), dim, NodeRecord{});
          std::fill_n(moment(i), dim * dim, NodeRecord{});
        }
    };
    if (some)
      clear(some->polynomials);
    else
      {
        std::fill(work.gradient.begin(), work.gradient.end(), NodeRecord{});
        std::fill(work.moment.begin(), work.moment.end(), NodeRecord{});
      }
    const auto add =
      [&](const LocalIndex i, const Shape &shape, const unsigned int side, const FaceSums<dim> &sums) {
        if (i >= n_owned_cells)
          return;
        const double sign = side == 0 ? 1. : -1.;
        NodeRecord  *g = gradient(i), *h = moment(i);
        for (unsigned int l = 0; l < dim; ++l)
          {
            const Lanes value = sign * sums.gradient[l];
            lanes(g[l]) += value;
            for (unsigned int k = 0; k < dim; ++k)
              lanes(h[dim * k + l]) += sign * sums.moment[k][l] + shape.offset[side][k] * value;
          }
      };
    visit_faces(
      some,
      [&](const auto axis, const Shape &shape, const AlignedFace<dim> &along, const Cells &cell) {
        sum_over_aligned<dim, axis()>(work, n_owned_cells, cell, shape.share, along);
      },
      [&](const Shape &shape, const Cells &cell, const unsigned int n_sides, const Held *of_face) {
        Lanes         polynomial[n_coefficients] = {};
        FaceSums<dim> sums;
        for (unsigned int side = 0; side < n_sides; ++side)
          add_shifted<dim>(work.polynomial.data() + n_coefficients * cell[side],
                           shape.offset[side].begin_raw(),
                           shape.share[side],
                           polynomial);
        integrate<dim>(face_moments->moments_of(shape), shape.is_plane, polynomial, sums);
        if (of_face != nullptr)
          {
            take_free_part<dim>(*of_face, sums);
            const auto centre = polynomials->centroids()[cell[0]] + shape.offset[0];
            for (unsigned int q = 0; at_faces != AtFaces::nothing && q < FaceMoments<dim>::n_points; ++q)
              {
                const auto &entry = prescribed->entries()[of_face->first_entry + q];
                const auto &point = face_moments->boundary_points()[entry.point];
                Lanes       value = {};
                for (int d = 0; d < dim; ++d)
                  value[d] =
                    of_face->mask[d] * (at_faces == AtFaces::values ? entry.value[d] : entry.increment[d]);
                for (unsigned int l = 0; l < dim; ++l)
                  {
                    sums.gradient[l] += point.area[l] * value;
                    for (unsigned int k = 0; k < dim; ++k)
                      sums.moment[k][l] += ((point.point[k] - centre[k]) * point.area[l]) * value;
                  }
              }
          }
        for (unsigned int side = 0; side < n_sides; ++side)
          add(cell[side], shape, side, sums);
      });
    if (some)
      clear(some->without_gradient);
  }

  template <int dim>
  void GradientMoments<dim>::spread_to_faces(const CellSubset *some) const
  {
    NodeRecord *const acting = work.polynomial.data();
    if (some)
      for (const LocalIndex i : some->polynomials)
        std::fill_n(acting + n_coefficients * i, n_coefficients, NodeRecord{});
    std::fill(acting + (some ? n_coefficients * n_owned_cells : 0), work.polynomial.end(), NodeRecord{});
    const auto add =
      [&](const LocalIndex i, const Shape &shape, const unsigned int side, FaceSums<dim> &sums) {
        if (i >= n_owned_cells)
          return;
        const double      sign = side == 0 ? 1. : -1.;
        const NodeRecord *g = gradient(i), *h = moment(i);
        for (unsigned int l = 0; l < dim; ++l)
          {
            Lanes pull = lanes(g[l]);
            for (unsigned int k = 0; k < dim; ++k)
              {
                pull += shape.offset[side][k] * lanes(h[dim * k + l]);
                sums.moment[k][l] += sign * lanes(h[dim * k + l]);
              }
            sums.gradient[l] += sign * pull;
          }
      };
    visit_faces(
      some,
      [&](const auto axis, const Shape &shape, const AlignedFace<dim> &along, const Cells &cell) {
        spread_to_aligned<dim, axis()>(work, n_owned_cells, cell, shape.share, along);
      },
      [&](const Shape &shape, const Cells &cell, const unsigned int n_sides, const Held *of_face) {
        FaceSums<dim> sums = {};
        Lanes         polynomial[n_coefficients];
        for (unsigned int side = 0; side < n_sides; ++side)
          add(cell[side], shape, side, sums);
        if (of_face != nullptr)
          take_free_part<dim>(*of_face, sums);
        integrate_back<dim>(face_moments->moments_of(shape), shape.is_plane, sums, polynomial);
        for (unsigned int side = 0; side < n_sides; ++side)
          add_shifted_back<dim>(polynomial,
                                shape.offset[side].begin_raw(),
                                shape.share[side],
                                work.polynomial.data() + n_coefficients * cell[side]);
      });
    add_to_owners(*of_polynomials, work.polynomial, work.temporary);
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientMoments)
} // namespace perideal
