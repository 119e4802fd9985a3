// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/mesh_error.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Estimates what the mesh leaves of error in the equilibrium of the linear consistent form.
    template <int dim>
    class DiscretisationErrorRecorder : public Recorder<dim>
    {
    public:
      explicit DiscretisationErrorRecorder(const Problem<dim> &problem)
        : problem(problem)
      {
      }

      void conclude(const Step<dim> &step, const Record &record) override
      {
        estimate                          = estimate_mesh_error(problem, step.time);
        record.summary["estimated_error"] = {{"l2", estimate.total()},
                                             {"smooth", estimate.smooth},
                                             {"rough", estimate.rough},
                                             {"surface", estimate.surface}};
      }

      std::string describe(const Json &, const bool is_done) const override
      {
        return is_done ? "error       " + in_words(estimate) + '\n' : "";
      }

    private:
      const Problem<dim> &problem;
      ErrorEstimate       estimate;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_discretisation_error_recorder(Problem<dim>  &problem,
                                                                    const RunKind &kind)
  {
    // The estimate takes no thermal strain.
    if (kind.has_motion || kind.has_iterations || !problem.discretisation.gradients.moments ||
        problem.loading.expansion)
      return nullptr;
    return std::make_unique<DiscretisationErrorRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_discretisation_error_recorder)
} // namespace perideal
