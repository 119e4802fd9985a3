// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/least_squares.h>
#include <perideal/problem/carried_softening.h>

#include <Eigen/Core>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// A loss that counts as none [-].
    constexpr double no_loss = 1e-3;
    /// Weight, over that of a bond that softened, of one that did not, which begins where these do in the
    /// mean: where F is not known else.
    constexpr double weight_of_mean = 0.01;
    /// Eigenvalues of normal equations, over the largest, that count as zero.
    constexpr double rank_of_directions = 1e-8;

    template <int dim>
    using Components = Eigen::Matrix<double, CarriedSoftening<dim>::n_components, 1>;

    /// The products that make e.H e of the components of H.
    template <int dim>
    Components<dim> products_of(const dealii::Tensor<1, dim> &e)
    {
      Components<dim> result;
      unsigned int    k = 0;
      for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
          result[k++] = e[a] * e[b];
      return result;
    }

    /// Fits e.A e to values along directions.
    template <int dim>
    class TensorFit
    {
      using Moments =
        Eigen::Matrix<double, Components<dim>::RowsAtCompileTime, Components<dim>::RowsAtCompileTime>;

    public:
      void add(const Components<dim> &products, const double value, const double weight)
      {
        moments.noalias() += weight * products * products.transpose();
        right += weight * value * products;
      }

      Components<dim> solve() const
      {
        const double largest = moments.diagonal().maxCoeff();
        if (!(largest > 0))
          return Components<dim>::Zero();
        return solve_semidefinite(
          Moments(moments / largest), Components<dim>(right / largest), rank_of_directions);
      }

    private:
      Moments         moments = Moments::Zero();
      Components<dim> right   = Components<dim>::Zero();
    };

    template <int dim>
    dealii::Tensor<1, dim> direction(const NodeArrays<dim> &nodes, const LocalIndex from, const LocalIndex to)
    {
      const dealii::Tensor<1, dim> bond = nodes.position[to] - nodes.position[from];
      return bond / bond.norm();
    }
  } // namespace

  template <int dim>
  NodeArray CarriedSoftening<dim>::fit(const Problem<dim> &problem, const BondArray &softened)
  {
    const Families<dim> &families = *problem.discretisation.families;
    const LocalIndex     n_owned  = families.n_owned();
    NodeArray            result{
      "-", width, std::vector<double>(std::size_t(width) * n_owned, 0.), Transfer::marks_halves};
    if (softened.bonds.empty())
      return result;
    // What softened, by slot; of nodes without such bonds nothing is fitted.
    const BondList                   &list = problem.force->bond_list();
    std::vector<const SoftenedBond *> of_slot(list.n_slots(), nullptr);
    std::vector<SoftenedBond>         bonds;
    std::vector<bool>                 is_lost(list.n_slots(), false), has_softened(families.n_local(), false);
    std::vector<double>               sum_of_first(n_owned, 0.);
    std::vector<unsigned int>         n_softened(n_owned, 0);
    for (std::size_t b = 0; b < softened.bonds.size(); ++b)
      bonds.push_back(BondMemory::bond(softened.values, b));
    for (std::size_t b = 0; b < bonds.size(); ++b)
      {
        const BondEnds &ends = softened.bonds[b];
        if (const BondIndex slot = list.find(ends.near, ends.far); slot != BondList::no_slot)
          of_slot[slot] = &bonds[b];
        for (const LocalIndex end : {ends.near, ends.far})
          if (end < n_owned)
            {
              has_softened[end] = true;
              sum_of_first[end] += bonds[b].first;
              ++n_softened[end];
            }
      }
    for (const auto &bond : problem.force->lost_bonds())
      is_lost[bond.slot] = true;

    std::vector<TensorFit<dim>> loss(n_owned), first(n_owned);
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        if (const LocalIndex j = list.neighbour[slot]; j != i && !is_lost[slot])
          {
            const Components<dim> products = products_of<dim>(direction(families, i, j));
            for (const LocalIndex end : {i, j})
              if (end < n_owned && has_softened[end])
                {
                  const SoftenedBond *bond = of_slot[slot];
                  loss[end].add(products, bond != nullptr ? 1. - bond->borne() : 0., 1.);
                  first[end].add(products,
                                 bond != nullptr ? bond->first : sum_of_first[end] / n_softened[end],
                                 bond != nullptr ? 1. : weight_of_mean);
                }
          }
    for (LocalIndex i = 0; i < n_owned; ++i)
      if (has_softened[i])
        {
          const Components<dim> h = loss[i].solve(), f = first[i].solve();
          const auto            of_node = result.values.begin() + std::size_t(width) * i + 1;
          std::copy_n(f.data(), n_components, std::copy_n(h.data(), n_components, of_node));
        }
    return result;
  }

  template <int dim>
  void CarriedSoftening<dim>::soften_halves(Problem<dim> &problem, const Checkpoint &state)
  {
    const auto found = state.node_arrays.find(name);
    if (found == state.node_arrays.end())
      return;
    const Families<dim> &families = *problem.discretisation.families;
    NodalVector          numbers(families.make_partitioner(width));
    std::copy(found->second.values.begin(), found->second.values.end(), numbers.begin());
    numbers.update_ghost_values();
    const auto along = [&](const LocalIndex i, const Components<dim> &products, const unsigned int first) {
      double result = 0;
      for (unsigned int k = 0; k < n_components; ++k)
        result += numbers.local_element(width * i + first + k) * products[k];
      return result;
    };
    const BondList &list = problem.force->bond_list();
    BondMemory      memory;
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        {
          const LocalIndex        j = list.neighbour[slot];
          std::vector<LocalIndex> halves;
          for (const LocalIndex end : {i, j})
            if (j != i && numbers.local_element(width * end) > 0)
              halves.push_back(end);
          if (halves.empty())
            continue;
          const Components<dim> products = products_of<dim>(direction(families, i, j));
          double                loss = 0, first = 0, n_first = 0;
          for (const LocalIndex end : halves)
            {
              loss += along(end, products, 1) / halves.size();
              const double of_end = along(end, products, 1 + n_components);
              first += of_end;
              n_first += of_end > 0;
            }
          if (loss > no_loss && n_first > 0)
            memory.add({i, j}, SoftenedBond::bearing(1. - std::min(loss, largest_loss), first / n_first));
        }
    problem.force->restore(memory);
  }

  template struct CarriedSoftening<2>;
  template struct CarriedSoftening<3>;
} // namespace perideal
