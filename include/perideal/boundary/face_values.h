// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_face_values_h
#define perideal_boundary_face_values_h

#include <perideal/parameters/load_parameters.h>
#include <perideal/reconstruction/boundary_point.h>

#include <array>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Prescribed displacements as values at the faces of the boundary: they take
   * the place of the interpolated ones in the face gradient, component by
   * component, so that no node is held and the operator keeps its symmetry.
   */
  template <int dim>
  class FaceValues
  {
  public:
    /// Nothing is prescribed.
    FaceValues() = default;

    /// @param points of the faces at the boundary
    FaceValues(const std::vector<BoundaryPoint<dim>> &points, const Loads<dim> &loads);

    static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int;

    /// A boundary point with at least one prescribed component.
    struct Entry
    {
      /// Number among the boundary points.
      unsigned int       point;
      dealii::Point<dim> position;
      /// That the point stands for [m^2].
      double area;
      /// Condition that prescribes each component, or `free`.
      std::array<unsigned int, dim> condition;
      /// Condition by which nothing moves along the normal of the face, or `free`; and that normal, else 0.
      unsigned int           sliding_condition;
      dealii::Tensor<1, dim> normal;
      /// Prescribed values [m]; 0 where free.
      dealii::Tensor<1, dim> value;
      /// What they have still to move [m].
      dealii::Tensor<1, dim> increment;
    };
    const std::vector<Entry> &entries() const { return list; }

    /// Evaluates the conditions.
    void set_time(const Loads<dim> &loads, const double time);

    /// Finds how far the values have to move until a time, without moving them.
    void prepare(const Loads<dim> &loads, const double time);
    /// The same for a step of motion, where velocities are prescribed too.
    void prepare_step(const Loads<dim> &loads, const double time, const double time_step);
    /// Moves the values by their increments.
    void move();
    /// Puts the values of all entries back [m], without increments.
    void set_values(const std::vector<dealii::Tensor<1, dim>> &values);
    /// The largest increment of this rank [m].
    double largest_increment() const;

    /// Takes what of the body force acts on the values [N], by entry.
    void bear(std::vector<dealii::Tensor<1, dim>> loads) { borne = std::move(loads); }

    /// Sums by condition of forces [N] that move the values of the entries, less what of these comes of body
    /// forces: what supports do to the body. Collective.
    std::vector<dealii::Tensor<1, dim>> sum_by_condition(const std::vector<dealii::Tensor<1, dim>> &forces,
                                                         MPI_Comm communicator) const;

    /// Sum of force times prescribed value [J]. Collective.
    double work(const std::vector<dealii::Tensor<1, dim>> &forces, MPI_Comm communicator) const;

  private:
    /// Gives the points of a face that slides its mean normal.
    void set_normals(const std::vector<BoundaryPoint<dim>> &points);

    std::vector<Entry>                  list;
    std::vector<dealii::Tensor<1, dim>> borne;
    unsigned int                        n_conditions = 0;
  };
} // namespace perideal

#endif
