// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/recorders/make_recorders.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

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

    /**
     * Records how far each condition has moved what it holds, "displacement of NAME along x [m]", for curves
     * of reactions: the mean over its faces of the displacement that it prescribes, or over the nodes or
     * faces that it holds of what its velocity has come to. Components that it leaves free are null in the
     * summary.
     */
    template <int dim>
    class DisplacementsRecorder : public Recorder<dim>
    {
    public:
      explicit DisplacementsRecorder(const Problem<dim> &problem)
        : problem(problem)
      {
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        const auto &conditions = problem.loading.loads.conditions;
        const auto  total      = sum_up(step.time);
        const char *axes[]     = {"x", "y", "z"};
        Json        result     = Json::object();
        for (std::size_t k = 0; k < conditions.size(); ++k)
          if (conditions[k].prescribes_displacement())
            for (unsigned int d = 0; d < dim; ++d)
              {
                const std::string &name = conditions[k].name;
                result[name].push_back(nullptr);
                if (!conditions[k].holds(d))
                  continue;
                result[name].back() = total.mean(k, d);
                record.history.add("displacement of " + name + " along " + axes[d] + " [m]",
                                   total.mean(k, d));
              }
        record.summary["displacements"] = result;
      }

    private:
      WeightedSums<dim> sum_up(const double time) const
      {
        const Loading<dim> &loading    = problem.loading;
        const auto         &conditions = loading.loads.conditions;
        WeightedSums<dim>   total(conditions.size());
        for (std::size_t k = 0; k < conditions.size(); ++k)
          visit_faces(conditions[k], problem.body.faces, [&](const BoundaryFace<dim> &face) {
            for (unsigned int d = 0; d < dim; ++d)
              if (const auto &prescribed = conditions[k].displacement[d]; prescribed.is_present())
                total.add(k, d, face.area, prescribed.value(face.centre, time));
          });
        for (const auto &entry : loading.supports->held().entries())
          if (conditions[entry.condition].velocity[entry.component].is_present())
            total.add(entry.condition,
                      entry.component,
                      entry.share,
                      problem.state.displacement[entry.node][entry.component]);
        if (const auto &at_faces = loading.supports->face_values(); at_faces != nullptr)
          for (const auto &entry : at_faces->entries())
            for (unsigned int d = 0; d < dim; ++d)
              if (const auto k = entry.condition[d];
                  k != FaceValues<dim>::free && conditions[k].velocity[d].is_present())
                total.add(k, d, entry.area, entry.value[d]);
        dealii::Utilities::MPI::sum(total.sums, problem.run.communicator, total.sums);
        return total;
      }

      const Problem<dim> &problem;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_displacements_recorder(Problem<dim> &problem, const RunKind &)
  {
    return std::make_unique<DisplacementsRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_displacements_recorder)
} // namespace perideal
