// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/line_to_point.h>
#include <perideal/boundary/surface_planes.h>
#include <perideal/materials/bond_based.h>
#include <perideal/treatments/treatments.h>

#include <deal.II/base/quadrature_lib.h>

/*
 * Treatments "line to point" and "published line to point" of tractions, of bond-based peridynamics in 3-D
 * (QUAD 4.1): what the material on the normals behind the surface, under the traction there, would do to the
 * nodes within their horizons of it,
 *
 *     F_i = V_i sum over faces of int f_L dS   (4.48),
 *
 * with the densities f_L of LineToPoint: the closed form by 3 x 3 Gauss points a face, the published one by
 * one, as on a grid of nodes. Tractions must be along the normal (4.47).
 */
namespace perideal
{
  namespace
  {
    /// Points of a face, with the area that each stands for.
    struct WeighedPoint
    {
      dealii::Point<3> position;
      double           area;
    };

    std::vector<WeighedPoint> points_of(const SurfaceFace<3> &face, const bool one)
    {
      if (one)
        return {{face.centre, face.area}};
      static const dealii::QGauss<2> gauss(3);
      std::vector<WeighedPoint>      result;
      double                         measure = 0;
      for (const auto &at : gauss.get_points())
        {
          // Bilinear in the corners, ordered as deal.II's.
          const auto            &v = face.vertices;
          const double           x = at[0], y = at[1];
          const dealii::Point<3> position(
            (1 - x) * (1 - y) * v[0] + x * (1 - y) * dealii::Tensor<1, 3>(v[1]) +
            (1 - x) * y * dealii::Tensor<1, 3>(v[2]) + x * y * dealii::Tensor<1, 3>(v[3]));
          const auto   along_x = (1 - y) * (v[1] - v[0]) + y * (v[3] - v[2]);
          const auto   along_y = (1 - x) * (v[2] - v[0]) + x * (v[3] - v[1]);
          const double area    = gauss.weight(result.size()) * cross_product_3d(along_x, along_y).norm();
          result.push_back({position, area});
          measure += area;
        }
      for (WeighedPoint &point : result)
        point.area *= face.area / measure;
      return result;
    }

    /// The tractions along the normals of faces [Pa].
    /// @throws InputError on all ranks where one is not along the normal.
    std::vector<double>
    normal_tractions(const std::vector<SurfaceFace<3>> &faces, const Loads<3> &loads, const double time)
    {
      std::vector<double> result(faces.size(), 0.);
      visit_loaded_faces(
        loads, faces, [&](const BoundaryCondition<3> &condition, const SurfaceFace<3> &face) {
          const auto   traction = Loads<3>::traction(condition, face.centre, face.normal, time);
          const double along    = traction * face.normal;
          if ((traction - along * face.normal).norm() > 1e-8 * traction.norm())
            throw InputError(
              "the closed form of the line-to-point force knows tractions along the normal only")
              .parameter("Boundary conditions/Traction treatment")
              .hint("set Boundary conditions/Treatment = taylor ghosts instead, or remove the tangential "
                    "traction of Boundary conditions/" +
                    condition.name);
          result[&face - faces.data()] += along;
        });
      return result;
    }

    using Density = LineToPoint::Density (LineToPoint::*)(double, double, double) const;

    /// @param points of each face @param density_of by traction, depth and distance
    void add_forces(const NodeCloud<3>                                 &nodes,
                    const std::vector<SurfaceFace<3>>                  &faces,
                    const std::vector<double>                          &traction,
                    const std::vector<std::vector<WeighedPoint>>       &points,
                    const std::function<LineToPoint(const LocalIndex)> &law_of,
                    const Density                                       density_of,
                    NodalVector                                        &force)
    {
      visit_nearby_faces<3>(
        nodes, faces, [&](const LocalIndex i, const std::vector<const SurfaceFace<3> *> &near) {
          const LineToPoint    law = law_of(i);
          dealii::Tensor<1, 3> sum;
          for (const auto *face : near)
            {
              const std::size_t k = face - faces.data();
              for (const WeighedPoint &point : points[k])
                {
                  const auto   to_point = point.position - nodes.position[i];
                  const double depth    = to_point * face->normal;
                  const auto   across   = to_point - depth * face->normal;
                  const double distance = across.norm();
                  if (depth < 0)
                    continue;
                  const auto density = (law.*density_of)(traction[k], depth, distance);
                  sum += point.area * density.along_normal * face->normal;
                  if (distance > 0)
                    sum += point.area * density.across / distance * across;
                }
            }
          for (int d = 0; d < 3; ++d)
            force.local_element(3 * i + d) += nodes.volume[i] * sum[d];
        });
    }

    template <int dim>
    class LineToPointTractions : public Tractions<dim>
    {
    public:
      LineToPointTractions(const TreatedBody<dim>  &body,
                           const TreatedBonds<dim> &bonds,
                           const Density            density,
                           const bool               one_point)
        : Tractions<dim>(body, bonds)
        , faces(gather_faces(body.faces, body.nodes.communicator))
        , density(density)
        , one_point(one_point)
      {
      }

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        if constexpr (dim == 3)
          {
            const std::vector<double>              traction = normal_tractions(faces, given, time);
            std::vector<std::vector<WeighedPoint>> points;
            for (std::size_t k = 0; k < faces.size(); ++k)
              points.push_back(traction[k] != 0 ? points_of(faces[k], one_point) :
                                                  std::vector<WeighedPoint>());
            const Nodes<dim> &nodes  = this->body.nodes;
            const auto        law_of = [&](const LocalIndex i) -> LineToPoint {
              const auto   solid   = this->bonds.solid_of(nodes.material[i]).isotropic();
              const double horizon = nodes.horizon[i];
              return {BondBased<dim>::micromodulus(solid.bulk_modulus(), horizon, this->body.mesh.thickness),
                      horizon,
                      solid.young_modulus,
                      solid.poisson_ratio};
            };
            add_forces(nodes, faces, traction, points, law_of, density, force);
          }
        else
          AssertThrow(false, dealii::ExcNotImplemented());
      }

      bool keep_balance() const override { return false; }

    private:
      const std::vector<SurfaceFace<dim>> faces;
      const Density                       density;
      const bool                          one_point;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_line_to_point(const TreatedBody<dim>  &body,
                                                        const TreatedBonds<dim> &bonds)
  {
    return std::make_unique<LineToPointTractions<dim>>(body, bonds, &LineToPoint::closed_form, false);
  }

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_published_line_to_point(const TreatedBody<dim>  &body,
                                                                  const TreatedBonds<dim> &bonds)
  {
    return std::make_unique<LineToPointTractions<dim>>(body, bonds, &LineToPoint::as_published, true);
  }

  PERIDEAL_INSTANTIATE(load_by_line_to_point)
  PERIDEAL_INSTANTIATE(load_by_published_line_to_point)
} // namespace perideal
