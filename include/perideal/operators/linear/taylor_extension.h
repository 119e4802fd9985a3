// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_taylor_extension_h
#define perideal_operators_linear_taylor_extension_h

#include <perideal/boundary/face_tractions.h>
#include <perideal/boundary/taylor_fit.h>
#include <perideal/operators/linear/bond_operator.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Bonds with what those would do that are missing behind the surface, whose far ends, the ghosts, move by a
   * Taylor polynomial T about the node that lacks them. T is fitted to the family and meets the boundary
   * conditions, tractions C:grad T n = t and displacements alike (TaylorFit; ghosts that move by Taylor
   * expansions as those of Scabbia, Zaccariotto, Galvanetto 2021, but without unknowns on the surface). Where
   * ghosts lie and how large they are does not matter: a whole family is in balance with -V div(C:grad T), so
   * that the missing bonds do
   *
   *     F_i = (K T)_i + V_i div(C:grad T),      (K u)_i - F_i = external force,
   *
   * on any mesh of one material and for any linear operator, the dilatations of truncated families included.
   * C is what the families inside have by their own quadrature (PolynomialResponse), or the material's where
   * all of the body is near its surface. On regular meshes displacements of second degree that meet the
   * boundary conditions are solutions to rounding: tension, shear and bending of a body of that stiffness.
   *
   * Within two horizons of the surface T is of second degree. Inside, families of irregular meshes lack
   * balance under uniform strains, too; there T is of first degree, which makes these exact. Of second degree
   * it would exchange the stiffness of the families for C by differences of near nodes: GMRES then did not
   * converge for the ordinary model on a graded mesh.
   *
   * The operator is not symmetric. T is linear in displacements u_j and in the given values g_k:
   * F_i = sum_j B_j u_j + sum_k b_k g_k.
   */
  template <int dim>
  class TaylorExtension : public BondOperator<dim>
  {
  public:
    /// @param bonds the operator of the bonds that are there
    /// @param families theirs
    /// @param faces of this rank @param surface faces of all ranks
    /// @param stiffness of the material, C [Pa]. Collective.
    TaylorExtension(const std::shared_ptr<const BondOperator<dim>> &bonds,
                    const std::shared_ptr<const Families<dim>>     &families,
                    const NodeCloud<dim>                           &nodes,
                    const std::vector<BoundaryFace<dim>>           &faces,
                    const std::vector<SurfaceFace<dim>>            &surface,
                    const Loads<dim>                               &loads,
                    const dealii::SymmetricTensor<4, dim>          &stiffness);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;

    /// Adds the forces on nodes that come of given tractions and displacements [N].
    void add_known(const Loads<dim> &loads, const double time, NodalVector &force) const;

    /// Of the bonds that are there.
    void visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override
    {
      bonds->visit_bond_forces(visit);
    }
    std::vector<double> dilatation() const override { return bonds->dilatation(); }
    bool                is_symmetric() const override { return false; }
    std::size_t         memory_consumption() const override;

    /// The bonds that are there.
    const BondOperator<dim> &plain_bonds() const { return *bonds; }

    /// C of ghosts [Pa].
    const dealii::SymmetricTensor<4, dim> &stiffness() const { return stiffness_of_bonds; }

    /// Nodes of this rank that lack bonds.
    LocalIndex n_incomplete() const { return static_cast<LocalIndex>(ghosts.rows.size()); }

    /// The traction C:grad T n at a point of a boundary face, seen from the node of its cell [Pa].
    struct FaceTraction
    {
      dealii::types::boundary_id boundary;
      FacePoint<dim>             point;
      dealii::Tensor<1, dim>     traction;
    };

    /// Tractions of a solution at the quadrature points of this rank's faces that have a condition [Pa].
    /// Collective.
    std::vector<FaceTraction>
    face_tractions(const NodalVector &displacement, const Loads<dim> &loads, const double time) const;

  private:
    /// Linear maps to vectors of dim components, from the displacements of local nodes and from known values.
    struct Rows
    {
      struct Row
      {
        LocalIndex  node;
        std::size_t first_node, first_known;
      };
      std::vector<Row>                    rows;
      std::vector<LocalIndex>             column;
      std::vector<dealii::Tensor<2, dim>> block;
      std::vector<SurfaceValue<dim>>      known;
      std::vector<dealii::Tensor<1, dim>> of_known;

      /// @param map from the coefficients of the polynomial
      template <typename MapOfCoefficients>
      void add(const MapOfCoefficients &map, const TaylorPolynomial<dim> &polynomial);

      dealii::Tensor<1, dim> of_nodes(const std::size_t r, const NodalVector &ghosted) const;
      dealii::Tensor<1, dim> of_loads(const std::size_t r, const Loads<dim> &loads, const double time) const;
      std::size_t            end_node(const std::size_t r) const
      {
        return r + 1 < rows.size() ? rows[r + 1].first_node : column.size();
      }
      std::size_t end_known(const std::size_t r) const
      {
        return r + 1 < rows.size() ? rows[r + 1].first_known : known.size();
      }
      std::size_t memory_consumption() const;
    };

    using NearFaces = std::vector<typename TaylorFit<dim>::NearFace>;

    /// For every owned node the faces that its horizon reaches and sees from inside, and whether no face is
    /// within two horizons.
    void find_near_faces(const NodeCloud<dim>                 &nodes,
                         const std::vector<BoundaryFace<dim>> &faces,
                         const std::vector<SurfaceFace<dim>>  &surface,
                         std::vector<NearFaces>               &near,
                         std::vector<std::uint8_t>            &is_inside) const;

    /// The tractions at the points of a face by the polynomial about its node.
    void add_face(const BoundaryFace<dim> &face, const TaylorPolynomial<dim> &polynomial);

    void import(const NodalVector &displacement) const;

    std::shared_ptr<const BondOperator<dim>> bonds;
    std::shared_ptr<const Families<dim>>     families;
    dealii::SymmetricTensor<4, dim>          stiffness_of_bonds;
    Rows                                     ghosts, tractions;
    /// What rows of tractions belong to, tractions left out.
    std::vector<FaceTraction> points;
    mutable NodalVector       ghosted;
  };
} // namespace perideal

#endif
