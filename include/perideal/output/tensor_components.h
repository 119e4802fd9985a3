// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_tensor_components_h
#define perideal_output_tensor_components_h

#include <string>
#include <vector>

namespace perideal
{
  /// A component of a symmetric tensor in space: its name in files, row and column.
  struct TensorComponent
  {
    std::string  name;
    unsigned int row, column;
  };

  /// The components that a body of this dimension can have, in the order of all files.
  template <int dim>
  std::vector<TensorComponent> tensor_components()
  {
    std::vector<TensorComponent> result = {{"xx", 0, 0}, {"yy", 1, 1}, {"zz", 2, 2}, {"xy", 0, 1}};
    if (dim == 3)
      result.insert(result.end(), {{"yz", 1, 2}, {"zx", 2, 0}});
    return result;
  }
} // namespace perideal

#endif
