// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/field_sink.h>
#include <perideal/output/tensor_components.h>

namespace perideal
{
  template <int dim>
  void FieldSink<dim>::add_tensor(const std::string                                &name,
                                  const std::vector<dealii::SymmetricTensor<2, 3>> &values)
  {
    std::vector<double> component(values.size());
    for (const auto &[suffix, a, b] : tensor_components<dim>())
      {
        for (std::size_t i = 0; i < values.size(); ++i)
          component[i] = values[i][a][b];
        add_scalar(name + "_" + suffix, component);
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(FieldSink)
} // namespace perideal
