// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_solids_h
#define perideal_tests_unit_solids_h

#include <perideal/parameters/elastic_solid.h>

#include <cmath>

/// Elastic solids that several rooms are tested with.
namespace perideal::test
{
  /// The stiffness [Pa] of a solid in space without any symmetry.
  inline dealii::SymmetricTensor<4, 3> stiffness_without_symmetry()
  {
    dealii::SymmetricTensor<4, 3> root, result = 0.5 * dealii::identity_tensor<3>();
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = k; l < 3; ++l)
            root[i][j][k][l] = std::cos(1. + 7. * i + 5. * j + 3. * k + 2. * l);
    // A tensor times its transpose is positive definite, whatever it is.
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = k; l < 3; ++l)
            for (int m = 0; m < 3; ++m)
              for (int n = 0; n < 3; ++n)
                result[i][j][k][l] += 0.2 * root[i][j][m][n] * root[k][l][m][n];
    return 70e9 * result;
  }

  template <int dim>
  ElasticSolid<dim> solid_without_symmetry(const PlaneAssumption in_plane = PlaneAssumption::plane_stress)
  {
    return {stiffness_without_symmetry(), dim == 2 ? in_plane : PlaneAssumption::solid};
  }
} // namespace perideal::test

#endif
