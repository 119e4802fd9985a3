// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_missing_bonds_h
#define perideal_operators_missing_bonds_h

#include <perideal/boundary/surface_planes.h>
#include <perideal/operators/bond_operator.h>
#include <perideal/operators/nodal_gradient.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Bonds with what those would do that are missing behind the surface: traction boundary conditions by the
   * discrete form of the line-to-point force density (QUAD 4.1). A whole family is in equilibrium under
   * a uniform strain, so that the missing bonds of node i, by the bonds' own quadrature, then pull with the
   * opposite of what the bonds that are there do,
   *
   *     F_i(missing) = M_i eps,    M_i E = (K (E x))_i,
   *
   * on any mesh of one material and for any model whose uniform strains need no forces inside the body. The
   * strain that they see is that of the solution (face gradient) as far as the known tractions t_k on the
   * planes n_k of the surface near the node leave it open: of all stresses with sigma n_k = t_k that which is
   * nearest to the solution's,
   *
   *     eps* = eps - C^-1 A^+ (A C eps - t),    A sigma = (sigma n_k)_k,
   *
   * on free faces with t = 0. The solution of a uniform stress is exact then: every node is in equilibrium
   * under u = E x, and its tractions are those of C E. The operator is K - M (1 - C^-1 A^+ A C) eps, and M
   * C^-1 A^+ t are forces on nodes. It is not symmetric.
   */
  template <int dim>
  class MissingBonds : public BondOperator<dim>
  {
  public:
    /// @param bonds the operator of the bonds that are there
    /// @param planes of the surface near each owned node
    /// @param boundaries of each condition of the loads
    /// @param solid_of every material of the nodes. Collective.
    MissingBonds(const std::shared_ptr<const BondOperator<dim>>             &bonds,
                 const std::shared_ptr<const FaceGradient<dim>>             &gradient,
                 const std::vector<std::vector<SurfacePlane<dim>>>          &planes,
                 const Loads<dim>                                           &loads,
                 const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                 const SolidOf<dim>                                         &solid_of);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> diagonal_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;

    /// Adds the forces on nodes that tractions make [N].
    void add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const;

    /// Of the bonds that are there.
    void visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override
    {
      bonds->visit_bond_forces(visit);
    }
    std::vector<double> dilatation() const override { return bonds->dilatation(); }
    bool                is_symmetric() const override { return false; }
    std::size_t         memory_consumption() const override;

    /// Nodes of this rank that lack bonds.
    LocalIndex n_incomplete() const { return static_cast<LocalIndex>(incomplete.size()); }

  private:
    static constexpr unsigned int n_strains = dim * (dim + 1) / 2;
    using Moment                            = Eigen::Matrix<double, dim, n_strains>;

    /// A component of traction that is known on a plane near a node.
    struct KnownTraction
    {
      SurfacePlane<dim>         plane;
      unsigned int              component;
      std::vector<unsigned int> conditions;
    };

    struct Incomplete
    {
      LocalIndex node;
      /// M (1 - C^-1 A^+ A C), and M C^-1 A^+, one column a known traction.
      Moment                                     of_strain;
      Eigen::Matrix<double, dim, Eigen::Dynamic> of_traction;
      std::vector<KnownTraction>                 tractions;
    };

    std::vector<Moment> find_moments() const;
    std::vector<KnownTraction>
    known_tractions(const std::vector<SurfacePlane<dim>>                       &planes,
                    const Loads<dim>                                           &loads,
                    const std::vector<std::vector<dealii::types::boundary_id>> &boundaries) const;
    /// The force of the missing bonds of a node per displacement of an entry of its gradient.
    dealii::Tensor<2, dim> block(const Incomplete &family, const dealii::Tensor<1, dim> &entry) const;

    std::shared_ptr<const BondOperator<dim>> bonds;
    NodalGradient<dim>                       gradient;
    std::vector<Incomplete>                  incomplete;
  };
} // namespace perideal

#endif
