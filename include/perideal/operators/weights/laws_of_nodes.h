// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_laws_of_nodes_h
#define perideal_operators_weights_laws_of_nodes_h

#include <perideal/boundary/cell_expansion.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/parameters/expanded_law.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace perideal
{
  /// The laws of the continuum at owned nodes, and in their cells where these would expand freely.
  template <int dim>
  class LawsOfNodes
  {
  public:
    /// @param laws by material id; every material of the nodes is listed
    LawsOfNodes(const Families<dim> &families, const LawsByMaterial<dim> &laws)
      : laws(laws)
    {
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        of_node.push_back(this->laws.at(families.material[i]).get());
    }

    /// From now on cells expand freely by what they have then.
    /// @param laws_in_space of materials in plane strain
    void expand(const Families<dim>                             &families,
                const LawsByMaterial<3>                         &laws_in_space,
                const std::shared_ptr<const CellExpansion<dim>> &of_cells)
    {
      in_space = laws_in_space;
      cells    = of_cells;
      for (LocalIndex i = 0; i < families.n_owned() && !in_space.empty(); ++i)
        in_space_of_node.push_back(in_space.at(families.material[i]).get());
    }

    /// Whether all are linear and strains small.
    bool are_linear() const
    {
      return std::all_of(laws.begin(), laws.end(), [](const auto &law) { return law.second->is_linear(); });
    }

    /// Whether cells may expand; else plain() is all that the loops need.
    bool                        expand_freely() const { return cells != nullptr; }
    const HyperelasticLaw<dim> &plain(const LocalIndex i) const { return *of_node[i]; }

    /// That of the mean expansion of the cell.
    ExpandedLaw<dim> mean(const LocalIndex i) const { return with(i, cells ? cells->mean[i] : 0.); }

    /// That at a point of the cell.
    /// @param offset with whose product with its moment the expansion is above its mean [1/m^4]
    ExpandedLaw<dim> at(const LocalIndex i, const dealii::Tensor<1, dim> &offset) const
    {
      return with(i, cells ? cells->mean[i] + offset * cells->moment[i] : 0.);
    }

    std::size_t memory_consumption() const
    {
      return (of_node.size() + in_space_of_node.size()) * sizeof(void *);
    }

  private:
    ExpandedLaw<dim> with(const LocalIndex i, const double expansion) const
    {
      return ExpandedLaw<dim>(
        *of_node[i], expansion, in_space_of_node.empty() ? nullptr : in_space_of_node[i]);
    }

    LawsByMaterial<dim>                       laws;
    LawsByMaterial<3>                         in_space;
    std::vector<const HyperelasticLaw<dim> *> of_node;
    std::vector<const HyperelasticLaw<3> *>   in_space_of_node;
    std::shared_ptr<const CellExpansion<dim>> cells;
  };
} // namespace perideal

#endif
