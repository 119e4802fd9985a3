// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_local_steps_h
#define perideal_operators_force_local_steps_h

#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include <cmath>
#include <vector>

namespace perideal
{
  /**
   * Knows which nodes move in shorter steps than the longest, in levels: those of level k in steps of about
   * 2^k times the shortest. A node is of the lowest level that its family asks for, so that those at a change
   * of cell size, whose families are stiffer than those of equal cells, move with the smaller ones.
   *
   * A family is of the lowest level of its members. Forces of bonds are split by blocks of rows of the bond
   * list (RestRegions::block_size), each of the lowest level of the families that its bonds belong to, those
   * of cells by cells. What nodes of level k do changes no family and no force of a higher level.
   */
  class LocalSteps
  {
  public:
    /// Collective.
    /// @param own level of each owned node by itself @param n_levels beyond the highest that there may be
    template <int dim>
    LocalSteps(const Families<dim>             &families,
               const BondList                  &bonds,
               const std::vector<unsigned int> &own,
               const unsigned int               n_levels);
    virtual ~LocalSteps() = default;

    /// Of two levels (SubSteps): nu is chosen, 1 without damping; with it fast motions of the lower level
    /// stay .15 of the 4 that leapfrog bears away from both of its bounds. omega takes them to the bounds,
    /// and the square of the longer step over the shorter one follows.
    static constexpr double nu            = 1.02;
    static constexpr double t_2           = 2. * nu * nu - 1.;
    static constexpr double omega         = 0.5 * (nu + 1.) / (1. + 1. / t_2);
    static constexpr double growth_square = 8. * nu * omega / t_2;
    /// How many times longer steps are than those of so many levels below.
    static double ratio(const unsigned int n_levels) { return std::pow(growth_square, 0.5 * n_levels); }

    unsigned int n_levels() const { return static_cast<unsigned int>(counts.size()); }

    unsigned int level_of(const LocalIndex node) const { return nodes[node]; }
    /// The lowest level whose blocks have bonds of an owned node.
    unsigned int level_of_force(const LocalIndex node) const { return forces[node]; }
    unsigned int level_of_block(const LocalIndex block) const { return blocks[block]; }

    /// The lowest level of the forces on prescribed values at faces, by entry of these; empty where forces
    /// know of none.
    const std::vector<unsigned int> &levels_of_supports() const { return supports; }

    /// Owned nodes, in their order: those of the levels up to one; those with families of these levels; those
    /// whose bonds are in blocks of these levels, or of this one alone.
    const std::vector<LocalIndex> &moving(const unsigned int level) const { return lists[level].moving; }
    const std::vector<LocalIndex> &families(const unsigned int level) const { return lists[level].families; }
    const std::vector<LocalIndex> &pulled(const unsigned int level) const { return lists[level].pulled; }
    const std::vector<LocalIndex> &pulled_alone(const unsigned int level) const
    {
      return lists[level].pulled_alone;
    }

    /// Whether any node of any rank is of this level or a lower one.
    bool any_up_to(const unsigned int level) const;

    /// Number of nodes of all ranks whose families have to be evaluated with this level, and with none below.
    const std::vector<GlobalIndex> &n_families() const { return counts; }

    /// Share of the families that steps evaluate, of all families in all of the shortest steps.
    double share_of_cell_steps() const;

    virtual std::size_t memory_consumption() const;

  protected:
    /// Of forces that are split by cells. Collective.
    /// @param nodes levels of the owned ones @param of_cells of what owned cells do @param pulled owned nodes
    /// on which cells of each level act @param supports as levels_of_supports()
    LocalSteps(const std::vector<unsigned int>            &nodes,
               const std::vector<unsigned int>            &of_cells,
               const std::vector<std::vector<LocalIndex>> &pulled,
               const std::vector<unsigned int>            &supports,
               MPI_Comm                                    communicator);

  private:
    void make_lists(const std::vector<unsigned int>            &of_families,
                    const std::vector<std::vector<LocalIndex>> &pulled,
                    MPI_Comm                                    communicator);

    /// By owned node, and by block of its rows.
    std::vector<unsigned int> nodes, forces, blocks, supports;
    struct Lists
    {
      std::vector<LocalIndex> moving, families, pulled, pulled_alone;
    };
    std::vector<Lists>       lists;
    std::vector<GlobalIndex> counts;
    unsigned int             lowest;
  };

  /// Returns the lowest level of each local node and its neighbours. Collective.
  /// @param levels of the owned nodes
  template <int dim>
  std::vector<unsigned int> lowest_of_neighbours(const Families<dim>             &families,
                                                 const BondList                  &bonds,
                                                 const std::vector<unsigned int> &levels);
} // namespace perideal

#endif
