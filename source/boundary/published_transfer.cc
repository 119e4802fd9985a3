// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/published_transfer.h>

namespace perideal
{
  namespace
  {
    /// Whether some faces hold component @p d, and whether some do not.
    template <int dim>
    std::pair<bool, bool> kinds_of_faces(const std::vector<int> &holder, const unsigned int d)
    {
      std::pair<bool, bool> result{false, false};
      for (std::size_t k = d; k < holder.size(); k += dim)
        (holder[k] >= 0 ? result.first : result.second) = true;
      return result;
    }
  } // namespace

  template <int dim>
  PublishedTransfer<dim>::PublishedTransfer(TransferFunctions<dim> functions,
                                            const Loads<dim>      &loads,
                                            const double           chi,
                                            const double           lambda)
    : functions(std::move(functions))
    , chi(chi)
    , lambda(lambda)
  {
    if (lambda == 0)
      return;
    for (const auto &face : this->functions.faces())
      for (unsigned int d = 0; d < dim; ++d)
        {
          holder.push_back(-1);
          for (std::size_t c = 0; c < loads.conditions.size(); ++c)
            if (loads.conditions[c].holds(d) && loads.conditions[c].acts_on(face.boundary))
              holder.back() = c;
        }
    make_springs();
  }

  template <int dim>
  void PublishedTransfer<dim>::make_springs()
  {
    const auto       &faces = functions.faces();
    const std::size_t n     = functions.volumes().size();
    for (unsigned int d = 0; d < dim; ++d)
      {
        // With all faces of one kind, the sum of L vanishes by (2.5).
        const auto [some_hold, some_do_not] = kinds_of_faces<dim>(holder, d);
        if (!some_hold || !some_do_not)
          continue;
        stiffness.resize(dim * n, 0.);
        double              sum_over_held = 0;
        std::vector<double> sum_at_node(n, 0.);
        for (std::size_t k = 0; k < faces.size(); ++k)
          if (holder[dim * k + d] >= 0)
            {
              sum_over_held += functions.node_sums()[k] * faces[k].area;
              for (const auto &[i, q] : functions.entries()[k])
                sum_at_node[i] += q * faces[k].area;
            }
        for (std::size_t i = 0; i < n; ++i)
          stiffness[dim * i + d] =
            functions.volumes()[i] * chi * chi / (chi - 1) * lambda *
            (sum_at_node[i] * functions.double_sum() - functions.face_sums()[i] * sum_over_held);
      }
  }

  template <int dim>
  void
  PublishedTransfer<dim>::add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    const auto &faces = functions.faces();
    visit_loaded_faces(
      loads, faces, [&](const BoundaryCondition<dim> &condition, const SurfaceFace<dim> &face) {
        const std::size_t k = &face - faces.data();
        if (functions.entries()[k].empty())
          return;
        // One point a face, as in (4.1).
        const auto pull = chi / (chi - 1) * face.area / functions.node_sums()[k] *
                          Loads<dim>::traction(condition, face.centre, face.normal, time);
        for (const auto &[i, q] : functions.entries()[k])
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * i + d) += q * functions.volumes()[i] * pull[d];
      });
  }

  template <int dim>
  void
  PublishedTransfer<dim>::add_places(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    if (lambda == 0)
      return;
    const auto       &faces = functions.faces();
    const std::size_t n     = functions.volumes().size();
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (!kinds_of_faces<dim>(holder, d).first)
          continue;
        double              sum_over_held = 0;
        std::vector<double> sum_at_node(n, 0.);
        for (std::size_t k = 0; k < faces.size(); ++k)
          if (const int c = holder[dim * k + d]; c >= 0)
            {
              const double place =
                faces[k].centre[d] + loads.conditions[c].displacement[d].value(faces[k].centre, time);
              sum_over_held += functions.node_sums()[k] * place * faces[k].area;
              for (const auto &[i, q] : functions.entries()[k])
                sum_at_node[i] += q * place * faces[k].area;
            }
        for (std::size_t i = 0; i < n; ++i)
          {
            force.local_element(dim * i + d) +=
              functions.volumes()[i] * chi * lambda *
              (sum_at_node[i] * functions.double_sum() - functions.face_sums()[i] * sum_over_held);
            if (!stiffness.empty())
              force.local_element(dim * i + d) -= stiffness[dim * i + d] * functions.positions()[i][d];
          }
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(PublishedTransfer)
} // namespace perideal
