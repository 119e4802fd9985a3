// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_external_forces_h
#define perideal_fem_external_forces_h

#include <perideal/fem/cell_integrals.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/load_parameters.h>

#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>

#include <map>

namespace perideal
{
  /// Computes body forces, tractions and point loads of a scene, cell by cell. They are dead loads: they act
  /// on the undeformed body and do not follow its deformation.
  template <int dim>
  class ExternalForces
  {
  public:
    using Cell = typename CellIntegrals<dim>::Cell;

    /// The loads must outlive this object.
    /// @throws InputError when a condition names a boundary the mesh has not.
    ExternalForces(const Mesh<dim> &mesh, const Loads<dim> &loads);

    /// From now on at @p time on these cells of the body. Collective.
    void
    reinit(const dealii::Triangulation<dim> &cells, const dealii::Mapping<dim> &mapping, const double time);

    /// Adds the nodal forces [N] on a locally owned cell.
    void add(const Cell &cell, CellIntegrals<dim> &integrals, dealii::Vector<double> &forces) const;

    /// Adds the springs at the faces of such a cell to its stiffness matrix [N/m].
    void
    add_springs(const Cell &cell, CellIntegrals<dim> &integrals, dealii::FullMatrix<double> &matrix) const;

  private:
    const Loads<dim> &loads;
    double            time = 0;
    bool              has_body_force;
    /// Conditions with a traction or pressure, by the boundary they act on.
    std::multimap<dealii::types::boundary_id, const BoundaryCondition<dim> *> tractions;
    /// Springs by the boundary that they hold.
    std::multimap<dealii::types::boundary_id, FaceSpring> springs;

    /// The part of a point load [N] that acts at a point of a cell.
    struct PointForce
    {
      dealii::Point<dim>     unit_point;
      dealii::Tensor<1, dim> force;
    };
    /// By active_cell_index().
    std::multimap<unsigned int, PointForce> point_forces;
  };
} // namespace perideal

#endif
