// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/recorders/make_recorders.h>

// The list of recorders, in the order of the history's columns: a new one is one file, which defines
// make_NAME_recorder(), and one line here.
#define PERIDEAL_RECORDERS(recorder)                                                                         \
  recorder(iterations) recorder(energy) recorder(damage) recorder(reactions) recorder(displacements)         \
    recorder(cracks) recorder(areal_forces) recorder(gauges) recorder(probes) recorder(finite_elements)      \
      recorder(comparison) recorder(load_resultants) recorder(discretisation_error)                          \
        recorder(boundary_stress) recorder(validity)

namespace perideal
{
#define PERIDEAL_DECLARE(name)                                                                               \
  template <int dim>                                                                                         \
  std::unique_ptr<Recorder<dim>> make_##name##_recorder(Problem<dim> &, const RunKind &);
  PERIDEAL_RECORDERS(PERIDEAL_DECLARE)
#undef PERIDEAL_DECLARE

  template <int dim>
  std::vector<std::unique_ptr<Recorder<dim>>> make_recorders(Problem<dim> &problem, const RunKind &kind)
  {
    std::vector<std::unique_ptr<Recorder<dim>>> result;
    // A recorder of what the scene does not have is null.
#define PERIDEAL_MAKE(name)                                                                                  \
  if (auto recorder = make_##name##_recorder<dim>(problem, kind))                                            \
    result.push_back(std::move(recorder));
    PERIDEAL_RECORDERS(PERIDEAL_MAKE)
#undef PERIDEAL_MAKE
    return result;
  }

  PERIDEAL_INSTANTIATE(make_recorders)
} // namespace perideal
