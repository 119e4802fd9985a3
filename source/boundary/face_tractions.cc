// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace perideal
{
  template <int dim>
  dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, dim> &vector)
  {
    dealii::Tensor<1, 3> result;
    for (int d = 0; d < dim; ++d)
      result[d] = vector[d];
    return result;
  }

  template <int dim>
  void Resultant<dim>::add(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &acting)
  {
    force += acting;
    moment += dealii::cross_product_3d(in_space(arm), in_space(acting));
  }

  namespace
  {
    template <int dim>
    struct FacePosition
    {
      dealii::Point<dim> point;
      /// Normal of either sense, as long as the surface element.
      dealii::Tensor<1, dim> element;
    };

    /// A place on the (bi)linear face through its corners.
    template <int dim, typename Face>
    FacePosition<dim> position_on(const Face &face, const dealii::Point<dim - 1> &reference)
    {
      using Geometry = dealii::GeometryInfo<dim - 1>;
      FacePosition<dim>                                  result;
      dealii::Tensor<1, dim - 1, dealii::Tensor<1, dim>> tangents;
      for (unsigned int v = 0; v < Geometry::vertices_per_cell; ++v)
        {
          result.point += Geometry::d_linear_shape_function(reference, v) * face.vertices[v];
          const auto slope = Geometry::d_linear_shape_function_gradient(reference, v);
          for (int d = 0; d < dim - 1; ++d)
            tangents[d] += slope[d] * face.vertices[v];
        }
      if constexpr (dim == 2)
        result.element = dealii::cross_product_2d(tangents[0]);
      else
        result.element = dealii::cross_product_3d(tangents[0], tangents[1]);
      return result;
    }
  } // namespace

  template <int dim, typename Face>
  std::vector<FacePoint<dim>> quadrature_points(const Face &face)
  {
    static const dealii::QGauss<dim - 1> gauss(2);
    std::vector<FacePoint<dim>>          result;
    double                               measure = 0;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const auto             at     = position_on<dim>(face, gauss.point(q));
        const double           length = at.element.norm();
        dealii::Tensor<1, dim> normal = at.element / length;
        if (normal * face.normal < 0)
          normal *= -1.;
        result.push_back({at.point, normal, gauss.weight(q) * length});
        measure += result.back().area;
      }
    // In 2-D that is the thickness.
    for (FacePoint<dim> &point : result)
      point.area *= face.area / measure;
    return result;
  }

  template <int dim, typename Face>
  Resultant<dim> integrate_traction(const BoundaryCondition<dim> &condition,
                                    const Face                   &face,
                                    const double                  time,
                                    const dealii::Point<dim>     &about)
  {
    Resultant<dim> result;
    for (const FacePoint<dim> &point : quadrature_points<dim>(face))
      result.add(point.position - about,
                 point.area * Loads<dim>::traction(condition, point.position, point.normal, time));
    return result;
  }

#define PERIDEAL_INSTANTIATE_FOR(dim, Face)                                                                  \
  template std::vector<FacePoint<dim>> quadrature_points(const Face<dim> &);                                 \
  template Resultant<dim>              integrate_traction(                                                   \
                 const BoundaryCondition<dim> &, const Face<dim> &, const double, const dealii::Point<dim> &);
  PERIDEAL_INSTANTIATE_FOR(2, BoundaryFace)
  PERIDEAL_INSTANTIATE_FOR(3, BoundaryFace)
  PERIDEAL_INSTANTIATE_FOR(2, SurfaceFace)
  PERIDEAL_INSTANTIATE_FOR(3, SurfaceFace)
#undef PERIDEAL_INSTANTIATE_FOR
  PERIDEAL_INSTANTIATE_CLASS(Resultant)
  template dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, 2> &);
  template dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, 3> &);
} // namespace perideal
