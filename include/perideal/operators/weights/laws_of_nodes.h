// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_laws_of_nodes_h
#define perideal_operators_weights_laws_of_nodes_h

#include <perideal/boundary/cell_expansion.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/operators/weights/point_lanes.h>
#include <perideal/parameters/expanded_law.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
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
    {
      for (const auto &[id, law] : laws)
        {
          OfMaterial &of_material = this->laws[id];
          of_material.law         = law;
          if (const auto *modulus = law->constant_modulus())
            of_material.modulus.emplace(*modulus);
        }
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        of_node.push_back(&this->laws.at(families.material[i]));
    }

    LawsOfNodes(const LawsOfNodes &)            = delete;
    LawsOfNodes &operator=(const LawsOfNodes &) = delete;

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
      return std::all_of(laws.begin(), laws.end(), [](const auto &of) { return of.second.law->is_linear(); });
    }

    /// Whether cells may expand; else plain() is all that the loops need.
    bool                        expand_freely() const { return cells != nullptr; }
    const HyperelasticLaw<dim> &plain(const LocalIndex i) const { return *of_node[i]->law; }

    /// dS/dE everywhere in the cell of a node, where it is the same at every strain; else null.
    const PointModulus<dim> *modulus(const LocalIndex i) const
    {
      const bool expands = cells && (cells->mean[i] != 0. || cells->moment[i].norm_square() != 0.);
      return of_node[i]->modulus && !expands ? &*of_node[i]->modulus : nullptr;
    }

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
        *of_node[i]->law, expansion, in_space_of_node.empty() ? nullptr : in_space_of_node[i]);
    }

    struct OfMaterial
    {
      std::shared_ptr<const HyperelasticLaw<dim>> law;
      std::optional<PointModulus<dim>>            modulus;
    };

    std::map<dealii::types::material_id, OfMaterial> laws;
    LawsByMaterial<3>                                in_space;
    std::vector<const OfMaterial *>                  of_node;
    std::vector<const HyperelasticLaw<3> *>          in_space_of_node;
    std::shared_ptr<const CellExpansion<dim>>        cells;
  };
} // namespace perideal

#endif
