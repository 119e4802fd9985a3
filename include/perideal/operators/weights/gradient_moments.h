// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_gradient_moments_h
#define perideal_operators_weights_gradient_moments_h

#include <perideal/base/lanes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/operators/weights/cell_subset.h>
#include <perideal/operators/weights/face_integrals.h>
#include <perideal/operators/weights/polynomial_loads.h>
#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/face_moments.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes the mean gradient of each cell and its first moment from the means of a displacement over the
   * cells, and the forces that belong to what acts on them. By the divergence theorem
   *
   *     V G_l   = sum_f int_f n_l v,
   *     H_kl    = int (x_k - x_ik) du/dx_l = sum_f int_f n_l (x_k - x_ik) v - delta_kl V w_i,
   *
   * with one value v at a face for both of its cells, the mean of their polynomials (CellPolynomials), or
   * what is prescribed there; at an open face (FaceMoments) with that of the cell itself. w_i is the mean of
   * the displacement; taking the mean itself would make H of checkerboards, which faces do not see, three
   * times that of their polynomials, and the largest eigenvalues with it. So w_i is a mean smoothed over the
   * cells around, chosen such that the trace of H is that of the cell's polynomial,
   *
   *     V w_i = 1/dim sum_f int_f n.(x - x_i) v - 1/dim int (x - x_i).grad p_i,
   *
   * which is the mean of quadratic fields on any mesh. Body forces act on w_i; with tractions on v all of it
   * is exact for quadratic displacements.
   *
   * Cells are numbered as their nodes in the graph of the polynomials.
   */
  template <int dim>
  class GradientMoments
  {
  public:
    static constexpr unsigned int n_coefficients = Monomials<dim>::n_coefficients;

    /// Collective.
    GradientMoments(const std::shared_ptr<const CellPolynomials<dim>> &polynomials,
                    const std::shared_ptr<const FaceMoments<dim>>     &face_moments,
                    const std::shared_ptr<const FaceValues<dim>>      &prescribed,
                    MPI_Comm                                           communicator);

    LocalIndex n_owned() const { return n_owned_cells; }

    const CellPolynomials<dim> &cell_polynomials() const { return *polynomials; }
    const FaceMoments<dim>     &faces() const { return *face_moments; }
    const FaceValues<dim>      &prescribed_values() const { return *prescribed; }

    /// Which prescribed values at faces count: none, those that they have, or what they have still to move.
    enum class AtFaces
    {
      nothing,
      values,
      increments
    };

    /// Computes G, H and the values at the centroids of a displacement of owned nodes [m]. Collective.
    /// @param some only for these; null: of all cells
    void
    read(const NodalVector &displacement, const AtFaces at_faces, const CellSubset *some = nullptr) const;

    /// Of an owned cell, lanes by component of the displacement: G_l [-], H_kl [m^3] behind k dim + l, and
    /// the coefficients of its polynomial about the centroid, of which the first is the value there [m].
    /// After read().
    NodeRecord       *gradient(const LocalIndex i) const { return work.gradient.data() + dim * i; }
    NodeRecord       *moment(const LocalIndex i) const { return work.moment.data() + dim * dim * i; }
    const NodeRecord *polynomial(const LocalIndex i) const
    {
      return work.polynomial.data() + n_coefficients * i;
    }
    /// What acts on the value at the centroid [N].
    NodeRecord &force(const LocalIndex i) const { return work.value_force[i]; }

    /// Computes the forces on nodes that belong to what acts on gradient(), moment() and polynomial()[0],
    /// which the caller has written to gradient(), moment() [N m, N/m^2] and force(). It leaves no
    /// polynomials. Collective.
    /// @param some those of the last read(): forces on other nodes than theirs stay as they are
    void transpose(NodalVector &force, const CellSubset *some = nullptr) const;

    /// Forces that supports exert on the body at the prescribed values [N], by entry, of the last
    /// transpose().
    /// @param some those of its cells
    std::vector<dealii::Tensor<1, dim>> support_forces(const CellSubset *some = nullptr) const;

    /// Adds the forces on owned nodes that belong to loads [N]. Collective.
    void add_nodal_forces(const PolynomialLoads<dim> &loads, NodalVector &force) const;

    /// Adds the forces on owned nodes that come of the body force [N]. Collective.
    /// @return what of it acts on the prescribed values instead [N], by entry: in cells at a held boundary
    /// w_i
    ///   is made of these too
    std::vector<dealii::Tensor<1, dim>> add_body_forces(const Mesh<dim>  &mesh,
                                                        const Nodes<dim> &nodes,
                                                        const Loads<dim> &loads,
                                                        const double      time,
                                                        NodalVector      &force) const;

    /// A point of an owned cell.
    struct Place
    {
      LocalIndex         cell;
      dealii::Point<dim> point;
    };
    /// Values of the polynomials at points [m], of a displacement of means. Collective.
    std::vector<dealii::Tensor<1, dim>> values_at(const std::vector<Place> &places,
                                                  const NodalVector        &displacement) const;

    std::size_t memory_consumption() const;

  private:
    using Face  = typename FaceMoments<dim>::Face;
    using Shape = typename FaceMoments<dim>::Shape;
    /// Components of a boundary face that are prescribed: 1 where so. Of a face that slides the normal, along
    /// which it does not move; else 0.
    struct Held
    {
      /// Takes what is prescribed out of a value at the face, or of what acts on it.
      Lanes free_part(const Lanes &value) const
      {
        double along = 0;
        for (int d = 0; d < dim; ++d)
          along += value[d] * normal[d];
        return (Lanes{1., 1., 1., 1.} - mask) * value - along * normal;
      }

      Lanes       mask, normal;
      std::size_t first_entry;
    };

    void number(MPI_Comm communicator);
    void collect_held();

    /// Places of the polynomials of a face's cells.
    std::array<LocalIndex, 2> cells_of(const Face &face, const bool is_inner) const
    {
      const auto place_of = [&](const LocalIndex node) {
        return node < n_owned_cells ? node : polynomial_of_ghost[node - n_owned_cells];
      };
      return {{place_of(face.node[0]), is_inner ? place_of(face.node[1]) : FaceMoments<dim>::none}};
    }

    void read_polynomials(const NodalVector &displacement, const CellSubset *some = nullptr) const;
    /// Calls along_axis(axis, shape, aligned, cells) for aligned inner faces, the axis as a constant, and
    /// any(shape, cells, n_sides, held) for other ones, with null where nothing is held.
    template <typename AlongAxis, typename Any>
    void visit_faces(const CellSubset *some, const AlongAxis &along_axis, const Any &any) const;
    void sum_over_faces(const AtFaces at_faces, const CellSubset *some) const;
    void spread_to_faces(const CellSubset *some) const;
    void spread_to_nodes(NodalVector &force, const CellSubset *some) const;
    /// Spreads what acts on the polynomial of one cell, which is the n-th of those that are closed, if any.
    void spread_cell(const LocalIndex i, const std::size_t n) const;

    std::shared_ptr<const CellPolynomials<dim>> polynomials;
    std::shared_ptr<const FaceMoments<dim>>     face_moments;
    std::shared_ptr<const FaceValues<dim>>      prescribed;

    LocalIndex                                                 n_owned_cells;
    std::vector<LocalIndex>                                    polynomial_of_ghost;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> of_displacements, of_polynomials;
    /// By shape.
    std::vector<AlignedFace<dim>> aligned;
    /// By face, all of them at the boundary.
    std::map<std::size_t, Held> held;

    /// What read() leaves, and transpose() uses.
    struct Work
    {
      dealii::AlignedVector<NodeRecord> displacement, polynomial, gradient, moment, value_force, trace_force;
      std::vector<double>               temporary;
    };
    mutable Work work;
  };
} // namespace perideal

#endif
