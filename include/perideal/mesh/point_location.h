// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_point_location_h
#define perideal_mesh_point_location_h

#include <deal.II/fe/mapping.h>
#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <vector>

namespace perideal
{
  /// Finds the cells of this rank that points lie in, at or near.
  template <int dim>
  class PointLocation
  {
  public:
    /// A cell, and where in it a point is.
    struct Place
    {
      typename dealii::Triangulation<dim>::active_cell_iterator cell;
      dealii::Point<dim>                                        unit_point;
      /// From the unit cell; 0 inside.
      double distance;
    };

    /// A cell that a point touches, of the @p n_sharing ones of all ranks.
    struct SharedPlace
    {
      Place        place;
      unsigned int n_sharing;
    };

    /// Which cells of this rank may hold a point.
    enum class Candidates
    {
      /// Those whose bounding box contains it.
      around_point,
      /// The nearest ones.
      nearest
    };

    /// Distances from the unit cell: a point of the cell, up to rounding; and
    /// the farthest that a point outside counts as on a curved boundary.
    static constexpr double inside = 1e-8, still_near = 0.1;

    /// The arguments must outlive this object.
    PointLocation(const dealii::Triangulation<dim> &triangulation, const dealii::Mapping<dim> &mapping);

    /// Calls visit(place) for candidate cells of this rank until it returns false.
    void visit(const dealii::Point<dim>                 &point,
               const Candidates                          candidates,
               const std::function<bool(const Place &)> &visit) const;

    /// This rank's cells at each of points that all ranks know: those that the
    /// point touches, or the nearest where it is outside. @p distances from the nearest
    /// cell's unit cell, the same on all ranks. Collective.
    std::vector<std::vector<SharedPlace>> share(const std::vector<dealii::Point<dim>> &points,
                                                std::vector<double>                   &distances) const;

    const dealii::GridTools::Cache<dim> &cache() const { return grid; }

  private:
    const dealii::Mapping<dim>   &mapping;
    dealii::GridTools::Cache<dim> grid;
  };
} // namespace perideal

#endif
