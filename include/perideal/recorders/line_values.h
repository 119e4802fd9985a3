// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_line_values_h
#define perideal_recorders_line_values_h

#include <perideal/recorders/point_values.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Interpolates displacement, strain and stress at evenly spaced points of straight lines through the body,
   * and beside them those of finite elements on the same mesh, where there are some.
   */
  template <int dim>
  class LineValues
  {
  public:
    struct Line
    {
      std::string        name;
      dealii::Point<dim> from, to;
      /// Ends included; those outside the body are left out.
      unsigned int n_points;
    };

    /// The problem must outlive this object. Collective.
    LineValues(const Problem<dim> &problem, const std::vector<Line> &lines);

    /// Writes line_NAME.csv for each line into a directory. Collective.
    /// @throws ComputationError when a file cannot be written.
    void write(const std::string &directory);

  private:
    /// A point of a line, at a distance from its beginning [m].
    struct Place
    {
      std::size_t        line;
      double             distance;
      dealii::Point<dim> point;
    };

    const Problem<dim>               &problem;
    const std::vector<Line>           lines;
    std::vector<Place>                places;
    std::unique_ptr<PointValues<dim>> values;
  };
} // namespace perideal

#endif
