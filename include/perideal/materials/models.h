// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_models_h
#define perideal_materials_models_h

#include <perideal/materials/linear_model.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace perideal
{
  /// The choices of sections "Material" and "Nodes" that say what a bond does.
  struct ModelParameters
  {
    std::string model              = "extended ordinary";
    std::string form               = "energy";
    std::string influence_function = "constant";

    void declare(dealii::ParameterHandler &prm);
  };

  /// @param thickness of a two-dimensional body [m], 1 in 3-D
  template <int dim>
  std::unique_ptr<LinearModel<dim>> create_model(const ModelParameters &parameters, const double thickness);
} // namespace perideal

#endif
