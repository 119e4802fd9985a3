// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_correspondence_rows_h
#define perideal_operators_weights_correspondence_rows_h

#include <perideal/base/lanes.h>
#include <perideal/materials/correspondence.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/operators/weights/add_block.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Evaluates the energy of the correspondence model (materials/correspondence.h) by rows: what node i needs
   * of its neighbours for G_i u and z_ij, and the forces on them,
   *
   *     dU/du_k = sum_i V_i P_i c_ik + bonds b_ij z_ij.
   *
   * Every node is visited once, with all of its family: gradient, stress, forces. What stands for P is the
   * caller's: the stress of a law, or a tangent on a gradient. What a rank finds for other ranks' nodes is
   * sent to them, instead of the stresses of those nodes to it.
   */
  template <int dim>
  class CorrespondenceRows
  {
  public:
    using Gradient = dealii::Tensor<2, dim>;

    /// @param solid_of by material id; every material of the nodes is listed. Collective.
    CorrespondenceRows(const std::shared_ptr<const Families<dim>> &families,
                       const Correspondence<dim>                  &model,
                       const SolidOf<dim>                         &solid_of);

    LocalIndex n_owned() const { return families->n_owned(); }

    /// Weighs the families of owned nodes anew.
    /// @param is_gone of bonds between an owned node and another local one
    void reweigh(const std::vector<LocalIndex>                                 &nodes,
                 const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone);

    /// Whether the bonds of an owned node span space.
    bool has_gradient(const LocalIndex i) const { return of_family.spans_space[i]; }

    /// Takes the displacement that the functions below work on. Collective.
    void read(const NodalVector &displacement) const;

    /// Calls visit(i, G_i u) for the owned nodes.
    template <typename Visit>
    void visit_gradients(const Visit &visit) const
    {
      for_all_nodes([&](const LocalIndex i, const Lanes(&g)[dim]) { visit(i, to_tensor(g)); });
    }

    /// dU/du [N] of owned nodes. Collective.
    /// @param stress_of P [Pa] by owned node and its gradient
    template <typename StressOf>
    void forces(NodalVector &force, const StressOf &stress_of) const;

    /// Energy of the penalty of a node's family [J], at the displacement read and its gradient.
    double penalty_energy(const LocalIndex i, const Gradient &g) const;

    /// Of the Hessian of U with dP/dF given by node [Pa]: blocks on the diagonal, and pieces as of
    /// BondOperator. Collective.
    using TangentOf = std::function<dealii::Tensor<4, dim>(const LocalIndex)>;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks(const TangentOf &tangent_of) const;
    void                                assemble(const TangentOf &tangent_of, const AddBlock &add) const;

    std::size_t memory_consumption() const;

  private:
    void weigh(const LocalIndex i, const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone);

    static Gradient to_tensor(const Lanes (&g)[dim])
    {
      Gradient result;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] = g[b][a];
      return result;
    }

    template <typename Visit>
    void for_all_nodes(const Visit &visit) const;
    template <typename StressOf>
    void sum_forces(const StressOf &stress_of) const;
    void collect(NodalVector &force) const;

    /// The row of a node, itself first.
    struct DenseRow
    {
      std::vector<LocalIndex>             column;
      std::vector<dealii::Tensor<1, dim>> c;
    };
    DenseRow dense_row(const LocalIndex i) const;

    std::shared_ptr<const Families<dim>> families;
    Correspondence<dim>                  model;
    /// By material [Pa].
    std::map<dealii::types::material_id, double> penalty_modulus;

    /// Members of owned families with a weight, [first[i], first[i+1]), with their c and b_ij.
    struct Members
    {
      std::vector<BondIndex>              first = {0};
      std::vector<LocalIndex>             member;
      std::vector<dealii::Tensor<1, dim>> c;
      std::vector<double>                 penalty;
      std::vector<bool>                   spans_space;
    };
    Members of_family;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<LocalIndex>                                    ghost_number;
    dealii::AlignedVector<NodeRecord>                          positions;

    /// What read() leaves, and forces().
    struct Work
    {
      dealii::AlignedVector<NodeRecord> displacements, forces;
      NodalVector                       ghosted, ghosted_forces;
    };
    mutable Work work;
  };

  template <int dim>
  template <typename Visit>
  void CorrespondenceRows<dim>::for_all_nodes(const Visit &visit) const
  {
    const NodeRecord *u = work.displacements.data();
    for (LocalIndex i = 0; i < n_owned(); ++i)
      {
        Lanes       g[dim] = {};
        const Lanes ui     = lanes(u[i]);
        for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
          {
            const Lanes difference = lanes(u[of_family.member[k]]) - ui;
            for (int b = 0; b < dim; ++b)
              g[b] += difference * of_family.c[k][b];
          }
        visit(i, g);
      }
  }

  template <int dim>
  template <typename StressOf>
  void CorrespondenceRows<dim>::sum_forces(const StressOf &stress_of) const
  {
    const NodeRecord *u = work.displacements.data(), *x = positions.data();
    NodeRecord       *f = work.forces.data();
    std::fill(work.forces.begin(), work.forces.end(), NodeRecord{});
    const bool stabilised = model.is_stabilised();
    for_all_nodes([&](const LocalIndex i, const Lanes(&g)[dim]) {
      const Gradient stress = families->volume[i] * stress_of(i, to_tensor(g));
      Lanes          t[dim] = {};
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          t[b][a] = stress[a][b];
      const Lanes ui = lanes(u[i]), xi = lanes(x[i]);
      Lanes       own = {};
      for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
        {
          const LocalIndex j    = of_family.member[k];
          Lanes            pull = {};
          if (stabilised)
            {
              const Lanes bond = lanes(x[j]) - xi;
              Lanes       z    = lanes(u[j]) - ui;
              for (int b = 0; b < dim; ++b)
                z -= g[b] * bond[b];
              pull = z * of_family.penalty[k];
            }
          for (int b = 0; b < dim; ++b)
            pull += t[b] * of_family.c[k][b];
          lanes(f[j]) += pull;
          own -= pull;
        }
      lanes(f[i]) += own;
    });
  }

  template <int dim>
  template <typename StressOf>
  void CorrespondenceRows<dim>::forces(NodalVector &force, const StressOf &stress_of) const
  {
    sum_forces(stress_of);
    collect(force);
  }
} // namespace perideal

#endif
