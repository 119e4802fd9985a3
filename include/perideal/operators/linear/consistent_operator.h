// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_consistent_operator_h
#define perideal_operators_linear_consistent_operator_h

#include <perideal/base/lanes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/materials/consistent.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/linear/symmetric_pairs.h>
#include <perideal/reconstruction/face_gradient.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Applies the internal force of the consistent form (materials/consistent.h),
   *
   *     eps_i = sym G_i u,   r_ij = xi.(u_j - u_i) - xi.eps_i xi,
   *     T_i   = V_i sigma(eps_i) - sum_j b_ij r_ij xi (x) xi,
   *     K u   = sum_i G_i^T T_i + bonds (b_ij r_ij + b_ji r_ji) xi,
   *
   * in three passes: rows of G, bonds once, rows of G transposed.
   *
   * Symmetric tensors are vectors of pairs (symmetric_pairs.h).
   *
   * Nodes are numbered as in the face gradient's graph, ghosts of the families that
   * are not in the graph behind them.
   */
  template <int dim>
  class ConsistentOperator : public BondOperator<dim>
  {
  public:
    /// @param solid_of by material id; every material of the nodes is listed. Collective.
    ConsistentOperator(const std::shared_ptr<const Families<dim>>     &families,
                       const std::shared_ptr<const FaceGradient<dim>> &gradient,
                       const std::shared_ptr<const FaceValues<dim>>   &prescribed,
                       const Consistent<dim>                          &model,
                       const SolidOf<dim>                             &solid_of);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    void internal_force(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> diagonal_blocks() const override;
    void        assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    bool        is_symmetric() const override { return true; }
    std::size_t memory_consumption() const override;

    /// Trace of the strain of the last vmult() or internal_force(), by owned node.
    std::vector<double> dilatation() const override;

    /// Forces that the supports exert on the body at the prescribed face values
    /// [N], by entry, after internal_force().
    std::vector<dealii::Tensor<1, dim>> support_forces() const override;

  private:
    using Symmetric                       = SymmetricPairs<dim>;
    using Pairs                           = typename Symmetric::Pairs;
    using PairRecord                      = typename Symmetric::PairRecord;
    static constexpr unsigned int n_pairs = Symmetric::n_pairs;
    static constexpr unsigned int n_parts = Symmetric::n_parts;
    /// Values of the two ends of every bond, by slot.
    struct Ends
    {
      std::vector<double> near, far;
    };
    /// What nodes are made of: C as a matrix on strain pairs, modulus of the bonds [Pa].
    struct Solid
    {
      std::array<Pairs, n_pairs> stiffness;
      double                     bond_modulus;
    };

    /// Prescribed entries [first, last) of a node.
    using EntryRange = std::pair<std::size_t, std::size_t>;

    void number_nodes();
    void set_solids(const SolidOf<dim> &solid_of);
    void weigh_bonds(const SolidOf<dim> &solid_of);

    void apply(NodalVector &force, const NodalVector &displacement, const bool with_prescribed) const;
    void import_displacement(const NodalVector &displacement) const;
    void compute_strains(const bool with_prescribed) const;
    /// Puts prescribed values (or zeros) in the place of interpolated ones.
    void
    replace_face_values(const EntryRange &range, const bool with_prescribed, dealii::Tensor<2, dim> &g) const;
    void import_strains() const;
    void sum_over_bonds() const;
    void turn_into_stress() const;
    void add_transposed_gradient() const;

    /// d strain/d u of one node: the strain of node i is sum_k strain_row[k] u_k
    /// over the columns k of its row, prescribed face values left out.
    using StrainRow = std::vector<std::array<dealii::Tensor<1, dim>, n_pairs>>;
    void strain_row(const LocalIndex i, StrainRow &row) const;
    /// V C as a matrix on strain pairs [Pa m^3].
    std::array<Pairs, n_pairs> elasticity(const LocalIndex i) const;
    /// Distance from the node of a member to another one in the former's horizon, squared.
    double distance_square(const LocalIndex m, const dealii::Tensor<1, dim> &bond) const
    {
      return families->shape.empty() ? bond.norm_square() / (families->horizon[m] * families->horizon[m]) :
                                       (families->shape[m] * bond).norm_square();
    }
    /// Calls visit(j, bond, b_ij) for the members of a family.
    template <typename Visit>
    void visit_family(const LocalIndex i, const Visit &visit) const;
    /// Adds what ranks have for each other's nodes to the owned ones. Collective.
    void collect(std::vector<dealii::Tensor<2, dim>> &blocks) const;

    std::shared_ptr<const Families<dim>>     families;
    std::shared_ptr<const FaceGradient<dim>> gradient;
    std::shared_ptr<const FaceValues<dim>>   prescribed;
    Consistent<dim>                          model;
    BondList                                 bonds;

    /// Local and global numbers of the nodes.
    struct Numbering
    {
      /// Nodes of the ghosts of a layout with dim values a node.
      std::vector<LocalIndex> nodes_of_ghosts(const dealii::Utilities::MPI::Partitioner &layout) const;

      LocalIndex n_owned, n_local;
      /// Node of each local number of the families.
      std::vector<LocalIndex>  node_of_member;
      std::vector<GlobalIndex> global;
      /// Node of each ghost of the layouts of `ghosted` and `ghosted_forces`.
      std::vector<LocalIndex> node_of_ghost, node_of_graph_ghost;
    };
    Numbering          numbering;
    std::vector<Solid> solids;
    /// By owned node, of the above.
    std::vector<LocalIndex> solid_of_node;
    /// Bond stiffness b of the families of either end, by slot [N/m^3].
    Ends stiffness;
    /// Prescribed entries [first, last) of the owned nodes that have any.
    std::map<LocalIndex, EntryRange>  prescribed_of_node;
    dealii::AlignedVector<NodeRecord> positions;

    /// Work space of vmult().
    struct Work
    {
      dealii::AlignedVector<NodeRecord> displacements, forces;
      dealii::AlignedVector<PairRecord> strains, stresses;
      NodalVector                       ghosted, ghosted_strains, ghosted_forces;
    };
    mutable Work work;
  };
} // namespace perideal

#endif
