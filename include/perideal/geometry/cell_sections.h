// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_cell_sections_h
#define perideal_geometry_cell_sections_h

#include <perideal/base/types.h>
#include <perideal/geometry/cell_vertices.h>

#include <deal.II/base/point.h>

#include <vector>

namespace perideal
{
  /// Part of a line.
  struct Interval
  {
    double begin, end;
  };

  /// Represents the intersection of a polygon and a disk about the origin; chords run along the second axis.
  class DiskedPolygon
  {
  public:
    struct Side
    {
      dealii::Point<2> a, b;
    };

    /// Sides in any order, around one polygon or several.
    std::vector<Side> sides;
    /// Square of the disk's radius; infinite: there is none.
    double radius_square = 0;

    /// Kinks of the limits of chords as their place y changes, ascending.
    void find_kinks(std::vector<double> &kinks) const;

    /// The parts of the line at @p y that lie in both.
    void find_chords(const double y, std::vector<Interval> &chords) const;

    /// Whether some chords at @p y end at the disk.
    bool ends_at_disk(const double y) const;

  private:
    mutable std::vector<double> crossings;
  };

  /// Represents the intersection of a cell and a ball about the origin. In 2-D the only section is the cell
  /// itself.
  template <int dim>
  class CellSections;

  template <>
  class CellSections<2>
  {
  public:
    CellSections(const CellVertices<2> &cell, const double radius);

    const DiskedPolygon &section() const { return polygon; }

  private:
    DiskedPolygon polygon;
  };

  template <>
  class CellSections<3>
  {
  public:
    CellSections(const CellVertices<3> &cell, const double radius);

    /// Kinks of the limits of sections as their place x changes, ascending.
    const std::vector<double> &kinks() const { return all_kinks; }

    /// Places near which limits go like square roots: where the circles end that the faces' planes cut from
    /// the ball. They may lie outside the cell.
    const std::vector<double> &roots() const { return all_roots; }

    /// The section at @p x, in y and z.
    const DiskedPolygon &section(const double x) const;

  private:
    /// A plane part of the surface.
    struct Face
    {
      std::vector<dealii::Point<3>> corners;
    };

    void find_kinks();
    /// Whether a point of its plane lies on a face.
    static bool is_on(const Face &face, const dealii::Point<3> &point, const dealii::Tensor<1, 3> &normal);

    std::vector<Face>     faces;
    double                radius;
    std::vector<double>   all_kinks, all_roots;
    mutable DiskedPolygon polygon;
  };
} // namespace perideal

#endif
