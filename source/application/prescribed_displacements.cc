// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/prescribed_displacements.h>
#include <perideal/base/instantiate.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  namespace
  {
    /// Sums of weighted displacements and of weights by condition and component, over all ranks.
    template <int dim>
    struct WeightedSums
    {
      explicit WeightedSums(const std::size_t n_conditions)
        : sums(2 * dim * n_conditions, 0.)
      {
      }

      void add(const std::size_t condition, const unsigned int d, const double weight, const double value)
      {
        sums[2 * (dim * condition + d)] += weight * value;
        sums[2 * (dim * condition + d) + 1] += weight;
      }

      double mean(const std::size_t condition, const unsigned int d) const
      {
        return sums[2 * (dim * condition + d)] / sums[2 * (dim * condition + d) + 1];
      }

      std::vector<double> sums;
    };
  } // namespace

  template <int dim>
  nlohmann::ordered_json
  record_displacements(const SceneState<dim> &scene, const double time, History &history)
  {
    const auto       &conditions = scene.loads.conditions;
    WeightedSums<dim> total(conditions.size());
    for (std::size_t k = 0; k < conditions.size(); ++k)
      visit_faces(conditions[k], scene.faces, [&](const BoundaryFace<dim> &face) {
        for (unsigned int d = 0; d < dim; ++d)
          if (const auto &prescribed = conditions[k].displacement[d]; prescribed.is_present())
            total.add(k, d, face.area, prescribed.value(face.centre, time));
      });
    for (const auto &entry : scene.held.entries())
      if (conditions[entry.condition].velocity[entry.component].is_present())
        total.add(
          entry.condition, entry.component, entry.share, scene.displacement[entry.node][entry.component]);
    dealii::Utilities::MPI::sum(total.sums, scene.nodes->communicator, total.sums);

    const char            *axes[] = {"x", "y", "z"};
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (std::size_t k = 0; k < conditions.size(); ++k)
      if (conditions[k].prescribes_displacement())
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::string &name = conditions[k].name;
            result[name].push_back(nullptr);
            if (!conditions[k].holds(d))
              continue;
            result[name].back() = total.mean(k, d);
            history.add("displacement of " + name + " along " + axes[d] + " [m]", total.mean(k, d));
          }
    return result;
  }

  PERIDEAL_INSTANTIATE(record_displacements)
} // namespace perideal
