// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/neighbourhood/point_tree.h>

#include <algorithm>
#include <utility>

// Families that are whole of some nodes only.

namespace perideal
{
  template <int dim>
  template <typename Visit>
  void Families<dim>::visit_members(const std::vector<bool> &chosen, const Visit &visit) const
  {
    std::vector<HorizonBox<dim>> boxes;
    for (LocalIndex i = 0; i < n_local(); ++i)
      boxes.push_back(HorizonBox<dim>::of(position[i], this->reach(i)));
    const auto              first_ghost = boxes.begin() + n_owned();
    const PointTree<dim>    owned({boxes.begin(), first_ghost}), ghosts({first_ghost, boxes.end()});
    std::vector<LocalIndex> leaves;
    const auto visit_in = [&](const PointTree<dim> &tree, const LocalIndex first, const LocalIndex i) {
      tree.find_leaves(boxes[i], leaves);
      for (const LocalIndex leaf : leaves)
        for (LocalIndex j = first + tree.leaf_begin(leaf); j < first + tree.leaf_end(leaf); ++j)
          if (j != i && are_members(i, j))
            visit(i, j);
    };
    for (LocalIndex i = 0; i < n_local(); ++i)
      if (chosen[i])
        {
          visit_in(owned, 0, i);
          if (i < n_owned())
            visit_in(ghosts, n_owned(), i);
        }
  }

  template <int dim>
  std::vector<bool> Families<dim>::with_members(const std::vector<bool> &chosen) const
  {
    NodalVector marks(make_partitioner(1));
    for (LocalIndex i = 0; i < n_owned(); ++i)
      marks.local_element(i) = chosen[i] ? 1. : 0.;
    // What owners say counts.
    const auto of_all_nodes = [&] {
      marks.update_ghost_values();
      std::vector<bool> result(n_local());
      for (LocalIndex i = 0; i < n_local(); ++i)
        result[i] = marks.local_element(i) > 0;
      marks.zero_out_ghost_values();
      return result;
    };
    visit_members(of_all_nodes(), [&](const LocalIndex, const LocalIndex j) {
      if (j < n_owned())
        marks.local_element(j) = 1.;
    });
    return of_all_nodes();
  }

  template <int dim>
  std::vector<bool> Families<dim>::with_all_members(const std::vector<bool> &chosen) const
  {
    NodalVector marks(make_partitioner(1));
    for (LocalIndex i = 0; i < n_owned(); ++i)
      marks.local_element(i) = chosen[i] ? 1. : 0.;
    visit_members(chosen, [&](const LocalIndex i, const LocalIndex j) {
      if (i < n_owned() && !chosen[j])
        marks.local_element(i) = 0.;
    });
    marks.update_ghost_values();
    std::vector<bool> result(n_local());
    for (LocalIndex i = 0; i < n_local(); ++i)
      result[i] = marks.local_element(i) > 0;
    return result;
  }

  template <int dim>
  std::shared_ptr<const Families<dim>> Families<dim>::whole_families(const std::vector<bool> &chosen) const
  {
    // Of the pairs with a chosen node, the rows of the owned ends.
    std::vector<std::pair<LocalIndex, LocalIndex>> pairs;
    visit_members(chosen, [&](const LocalIndex i, const LocalIndex j) {
      if (i < n_owned())
        pairs.emplace_back(i, j);
      if (j < n_owned() && !chosen[j])
        pairs.emplace_back(j, i);
    });
    auto result = std::make_shared<Families>(*this);
    result->row.assign(n_owned() + 1, 0);
    for (const auto &[i, j] : pairs)
      ++result->row[i + 1];
    for (LocalIndex i = 0; i < n_owned(); ++i)
      result->row[i + 1] += result->row[i];
    result->neighbour.resize(pairs.size());
    std::vector<BondIndex> next(result->row.begin(), result->row.end() - 1);
    for (const auto &[i, j] : pairs)
      result->neighbour[next[i]++] = j;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      std::sort(result->neighbour.begin() + result->row[i], result->neighbour.begin() + result->row[i + 1]);
    result->what_is_listed = {1., {chosen.begin(), chosen.begin() + n_owned()}};
    result->count();
    return result;
  }

#define PERIDEAL_INSTANTIATE_WHOLE(dim)                                                                      \
  template std::vector<bool> Families<dim>::with_members(const std::vector<bool> &) const;                   \
  template std::vector<bool> Families<dim>::with_all_members(const std::vector<bool> &) const;               \
  template std::shared_ptr<const Families<dim>> Families<dim>::whole_families(const std::vector<bool> &)     \
    const;
  PERIDEAL_INSTANTIATE_WHOLE(2)
  PERIDEAL_INSTANTIATE_WHOLE(3)
#undef PERIDEAL_INSTANTIATE_WHOLE
} // namespace perideal
