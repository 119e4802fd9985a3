// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <algorithm>
#include <tuple>

// The faces of cells from which GradientRows makes their rows, and which cells are equal by them.

namespace perideal
{
  template <int dim>
  void GradientRows<dim>::collect_sides(const FaceValues<dim> &prescribed)
  {
    const LocalIndex                              n_owned = polynomials.graph().n_owned();
    std::map<unsigned int, std::array<bool, dim>> held;
    for (const auto &entry : prescribed.entries())
      for (int d = 0; d < dim; ++d)
        // A face that slides along no axis is taken for one that does: a preconditioner needs no more.
        held[face_moments.boundary_points()[entry.point].face][d] =
          entry.condition[d] != FaceValues<dim>::free || entry.normal[d] * entry.normal[d] > 0.5;
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
            if (f >= face_moments.first_boundary_face())
              if (const auto of = held.find(f - face_moments.first_boundary_face()); of != held.end())
                side.held = of->second;
            sides[next[faces[f].node[s]]++] = side;
          }
    // Equal cells have equal sides in the same order, whichever of their neighbours came first.
    for (LocalIndex i = 0; i < n_owned; ++i)
      std::sort(
        sides.begin() + first_side[i], sides.begin() + first_side[i + 1], [&](const Side &a, const Side &b) {
          return std::make_tuple(faces[a.face].shape, a.side, a.face) <
                 std::make_tuple(faces[b.face].shape, b.side, b.face);
        });
  }

  template <int dim>
  bool GradientRows<dim>::describe(const LocalIndex i, std::vector<EqualRecords::Entry> &record) const
  {
    record.clear();
    const auto add = [&](const std::size_t number) { record.push_back(EqualRecords::exactly(number)); };
    const auto add_polynomial = [&](const LocalIndex node) {
      if (node >= polynomials.graph().n_owned() || directions_of(node).size() > 0)
        return false;
      add(polynomials.kind_of(node));
      return true;
    };
    if (!add_polynomial(i))
      return false;
    for (std::size_t s = first_side[i]; s < first_side[i + 1]; ++s)
      {
        const auto &face = face_moments.faces()[sides[s].face];
        add(face.shape);
        add(sides[s].side);
        for (const bool held : sides[s].held)
          add(held);
        if (const LocalIndex other = face.node[1 - sides[s].side];
            other != FaceMoments<dim>::none && !add_polynomial(other))
          return false;
      }
    return true;
  }

  PERIDEAL_INSTANTIATE_CLASS(GradientRows)
} // namespace perideal
