// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_treatments_treated_body_h
#define perideal_treatments_treated_body_h

#include <perideal/base/timing.h>
#include <perideal/boundary/boundary_faces.h>
#include <perideal/materials/linear_model.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/operators/weights/cell_shares.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// The body in its nodes, and its loads. What is referred to must outlive the treatments.
  template <int dim>
  struct TreatedBody
  {
    const Mesh<dim>                      &mesh;
    const Nodes<dim>                     &nodes;
    const std::vector<BoundaryFace<dim>> &faces;
    const Loads<dim>                     &loads;
    const LoadParameters                 &parameters;
    Timings                              &timings;
  };

  /// What treatments may want to know of the bonds of that body.
  template <int dim>
  struct TreatedBonds
  {
    std::shared_ptr<const Families<dim>> families;
    /// Of the consistent form.
    std::shared_ptr<const GradientMoments<dim>> moments;
    /// As the model takes them.
    SolidOf<dim> solid_of;
    /// What of the energy of cells is that of the consistent form; null: all.
    std::shared_ptr<const CellShares> shares = nullptr;
  };
} // namespace perideal

#endif
