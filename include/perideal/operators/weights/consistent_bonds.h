// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_consistent_bonds_h
#define perideal_operators_weights_consistent_bonds_h

#include <perideal/base/lanes.h>
#include <perideal/base/symmetric_pairs.h>
#include <perideal/materials/consistent.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/operators/weights/cell_shares.h>
#include <perideal/operators/weights/cell_subset.h>
#include <perideal/reconstruction/cell_polynomials.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes what the bonds of the consistent form (materials/consistent.h) do: the derivatives of
   * 1/2 sum b_ij r_ij^2 with respect to the states of its two ends, which are the displacement u at the
   * centroid and the strain. Of small strains
   *
   *     r_ij = xi.(u_j - u_i) - 1/2 xi.(eps_i + eps_j) xi,
   *
   * and of finite ones, with the positions y and Green's strain E,
   *
   *     r_ij = 1/2 (|y_j - y_i|^2 - |xi|^2) - 1/2 xi.(E_i + E_j) xi,
   *
   * which no uniform deformation and no rotation changes, and whose linearisation at rest is the former.
   *
   * Whoever uses them writes the states of owned nodes, sums, and reads forces and stresses.
   */
  template <int dim>
  class ConsistentBonds
  {
  public:
    using Symmetric                       = SymmetricPairs<dim>;
    using Pairs                           = typename Symmetric::Pairs;
    static constexpr unsigned int n_parts = Symmetric::n_parts;
    /// Displacement and strain, lanes as in a PairRecord.
    static constexpr unsigned int n_records = 1 + n_parts;

    /// @param solid_of by material id; every material of the nodes is listed
    /// @param is_cut bonds that cracks cut, which have no stiffness; empty: none. Collective.
    ConsistentBonds(const std::shared_ptr<const Families<dim>> &families,
                    const CellPolynomials<dim>                 &polynomials,
                    const Consistent<dim>                      &model,
                    const SolidOf<dim>                         &solid_of,
                    const BondPredicate<dim>                   &is_cut = {});

    /// Writes the state of an owned node.
    /// @param strain in pairs (xx, yy, .., 2xy, ..)
    void set_state(const LocalIndex i, const NodeRecord &displacement, const Pairs &strain)
    {
      NodeRecord *state = work.states.data() + n_records * i, *pairs = state + 1;
      state[0] = displacement;
      for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
        Symmetric::pair(pairs, p) = strain[p];
    }

    /// Sums over the bonds of a body at small strain, of the states set. Collective.
    /// @param some only over those of the rows of its cells; null: over all
    void sum_small(const CellSubset *some = nullptr);
    /// The same at finite strain. Collective.
    void sum_finite(const CellSubset *some = nullptr);

    /// What forces at finite strain change with.
    struct Linearisation
    {
      /// Of local nodes in the deformed body [m].
      dealii::AlignedVector<NodeRecord> position;
      /// b_ij r_ij by slot [N/m]; single precision does for tangents.
      std::vector<float> tension;
    };
    /// The linearisation at the states of the last sum_finite().
    Linearisation linearise() const;
    /// Sums the changes of forces and stresses, of states that are changes. Collective.
    void sum_changes(const Linearisation &at);

    /// Of an owned node: dU/du [N], and dU/d strain [N m] as pairs without the twos or as a tensor, after a
    /// sum.
    const NodeRecord &force(const LocalIndex i) const { return work.forces[i]; }
    double            stress(const LocalIndex i, const unsigned int pair) const
    {
      const NodeRecord *record = work.stresses.data() + n_parts * i;
      return Symmetric::pair(record, pair);
    }
    dealii::SymmetricTensor<2, dim> stress(const LocalIndex i) const
    {
      dealii::SymmetricTensor<2, dim> result;
      for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
        result[Symmetric::axes(p).first][Symmetric::axes(p).second] = stress(i, p);
      return result;
    }

    /// Energy of the bonds of this rank at the states of the last sum [J]; of those that the partition cuts,
    /// half.
    double energy_small() const { return energy(false); }
    double energy_finite() const { return energy(true); }

    const BondList &list() const { return bonds; }
    /// b_ij of both families, by slot [N/m^3]; zero of padding.
    double stiffness(const BondIndex slot) const { return stiffness_of[slot]; }
    /// Takes a bond's stiffness away.
    void remove(const BondIndex slot)
    {
      stiffness_of[slot] = 0.;
      if (!whole_stiffness.empty())
        whole_stiffness[slot] = 0.;
    }

    /// Scales stiffnesses by the shares of cells, which whoever sums over these scales by them too.
    /// @param of_nodes by local node
    void set_shares(const std::vector<double> &of_nodes);
    /// The shares set.
    std::shared_ptr<const CellShares> shares() const { return shares_of_cells; }
    /// That of a node.
    double share(const LocalIndex i) const { return shares_of_cells->of(i); }

    /// The strain of an owned node that was set last.
    dealii::SymmetricTensor<2, dim> strain(const LocalIndex i) const
    {
      const NodeRecord               *pairs = work.states.data() + n_records * i + 1;
      dealii::SymmetricTensor<2, dim> result;
      for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
        {
          const auto [a, b] = Symmetric::axes(p);
          result[a][b]      = (a == b ? 1. : 0.5) * Symmetric::pair(pairs, p);
        }
      return result;
    }
    /// The bond of an owned node with another local one [m].
    dealii::Tensor<1, dim> bond(const LocalIndex i, const LocalIndex j) const
    {
      dealii::Tensor<1, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = position[j].value[d] - position[i].value[d];
      return result;
    }

    std::size_t memory_consumption() const;

  private:
    enum class Kinematics
    {
      small,
      finite,
      change
    };
    /// @param at of changes; else null
    /// @param some as above
    template <Kinematics kinematics>
    void   sum(const Linearisation *at, const CellSubset *some);
    double energy(const bool is_finite) const;
    /// r of a bond of an owned node at the states set [m^2].
    double residual(const LocalIndex i, const LocalIndex j, const bool is_finite) const;
    void weigh(const Consistent<dim> &model, const SolidOf<dim> &solid_of, const BondPredicate<dim> &is_cut);
    void update_ghosts();

    std::shared_ptr<const Families<dim>> families;
    BondList                             bonds;
    std::vector<double>                  stiffness_of;
    /// With the whole stiffnesses, once shares were set.
    std::shared_ptr<CellShares> shares_of_cells = std::make_shared<CellShares>();
    std::vector<double>         whole_stiffness;
    /// Centroids of local nodes [m].
    dealii::AlignedVector<NodeRecord>                          position;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> of_states;

    struct Work
    {
      dealii::AlignedVector<NodeRecord> states, forces, stresses;
      std::vector<double>               buffer;
    };
    Work work;
  };
} // namespace perideal

#endif
