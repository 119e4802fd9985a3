// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/work_progress.h>
#include <perideal/operators/weights/bond_weights.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  template <int dim>
  std::shared_ptr<BondWeights<dim>> BondWeights<dim>::scaled(const std::vector<double> &) const
  {
    AssertThrow(false, dealii::ExcNotImplemented());
    return {};
  }

  template <int dim>
  void BondWeights<dim>::visit_families(const SolidOf<dim>       &solid_of,
                                        const BondPredicate<dim> &is_cut,
                                        const VisitFamily        &visit)
  {
    reports.resize(families->n_owned());
    BondCursor                   cursor(bonds);
    std::vector<BondCursor::End> ends;
    FamilyView<dim>              view;
    dealii::types::material_id   material = dealii::numbers::invalid_material_id;
    unsigned int                 n_empty  = 0;
    WorkProgress                 progress("weighing bonds", families->n_owned());
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        progress(i);
        // The cursor goes from family to family.
        cursor.find(i, families->begin(i), families->end(i), ends);
        if (!families->is_whole(i))
          continue;
        view.reinit(
          *families,
          i,
          is_cut ? [&](const LocalIndex j) { return is_cut(families->position[i], families->position[j]); } :
                   std::function<bool(const LocalIndex)>());
        n_empty += view.size == 0 && !is_cut ? 1 : 0;
        // Neighbours on the curve are mostly of one material.
        if (families->material[i] != material)
          {
            material = families->material[i];
            view.set_solid(solid_of(material));
          }
        visit(view, ends);
      }
    n_empty = dealii::Utilities::MPI::sum(n_empty, families->communicator);
    if (n_empty > 0)
      throw InputError("the horizons of " + std::to_string(n_empty) + " nodes hold no part of a neighbour")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor, or set Quadrature/Scheme = partial volume");
  }

  template <int dim>
  void BondWeights<dim>::weigh(LinearModel<dim>      &model,
                               const FamilyView<dim> &family,
                               FamilyCoefficients    &coefficients)
  {
    coefficients.resize(family.size, shape);
    model.compute(family, coefficients);
    reports[family.node] = coefficients.report;
    ++n_weighed;
  }

  template <int dim>
  void BondWeights<dim>::count_reports()
  {
    counts = {};
    for (const FamilyReport &report : reports)
      {
        counts.fallback += report.fallback;
        counts.singular += report.singular;
        counts.indefinite += report.indefinite;
      }
    counts.different = n_weighed;
    for (GlobalIndex *count : {&counts.fallback, &counts.singular, &counts.indefinite, &counts.different})
      *count = dealii::Utilities::MPI::sum(*count, families->communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(BondWeights)
} // namespace perideal
