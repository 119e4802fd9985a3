// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/cell_reach.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace perideal
{
  namespace
  {
    /// A number by local node, zero at first. Collective.
    template <typename Numbering>
    NodalVector numbers_of_nodes(const Numbering &numbering)
    {
      return NodalVector(numbering.make_partitioner(1));
    }

    /// The owned nodes that any rank has marked. Collective.
    std::vector<LocalIndex> collect_marked(NodalVector &marks)
    {
      marks.compress(dealii::VectorOperation::add);
      std::vector<LocalIndex> result;
      for (LocalIndex i = 0; i < marks.locally_owned_size(); ++i)
        if (marks.local_element(i) > 0)
          result.push_back(i);
      return result;
    }
  } // namespace

  template <int dim>
  typename CellReach<dim>::FaceCells CellReach<dim>::cells_of(const std::size_t face) const
  {
    FaceCells result;
    for (const LocalIndex node : moments.faces().faces()[face].node)
      if (node != FaceMoments<dim>::none)
        result.push_back(node);
    return result;
  }

  template <int dim>
  std::vector<unsigned int> CellReach<dim>::lowest_levels(const std::vector<unsigned int> &of_nodes) const
  {
    const CellPolynomials<dim> &polynomials = moments.cell_polynomials();
    const LocalIndex            n_owned     = moments.n_owned();
    NodalVector                 of_node     = numbers_of_nodes(polynomials.graph()), of_polynomial(of_node);
    std::copy_n(of_nodes.begin(), n_owned, of_node.begin());
    of_node.update_ghost_values();
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        double &lowest = of_polynomial.local_element(i);
        lowest         = of_node.local_element(i);
        for (BondIndex k = polynomials.first()[i]; k < polynomials.first()[i + 1]; ++k)
          lowest = std::min(lowest, of_node.local_element(polynomials.columns()[k]));
      }
    of_polynomial.update_ghost_values();

    NodalVector of_gradient = numbers_of_nodes(families);
    std::fill_n(of_gradient.begin(), n_owned, std::numeric_limits<double>::max());
    for (std::size_t f = 0; f < moments.faces().faces().size(); ++f)
      for (const LocalIndex i : cells_of(f))
        for (const LocalIndex j : cells_of(f))
          if (i < n_owned)
            of_gradient.local_element(i) =
              std::min(of_gradient.local_element(i), of_polynomial.local_element(j));
    of_gradient.update_ghost_values();

    std::vector<unsigned int> result;
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        double lowest = of_gradient.local_element(i);
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
          lowest = std::min(lowest, of_gradient.local_element(bonds.neighbour[k]));
        result.push_back(static_cast<unsigned int>(lowest));
      }
    return result;
  }

  template <int dim>
  CellSubset CellReach<dim>::subset(const std::vector<LocalIndex> &own) const
  {
    const CellPolynomials<dim> &polynomials = moments.cell_polynomials();
    CellSubset                  result;
    result.own        = own;
    NodalVector marks = numbers_of_nodes(families);
    for (const LocalIndex i : own)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        marks.local_element(bonds.neighbour[k]) = 1.;
    const std::vector<LocalIndex> ends = collect_marked(marks);
    std::set_difference(
      ends.begin(), ends.end(), own.begin(), own.end(), std::back_inserter(result.far_ends));

    std::vector<bool> has_gradient(moments.n_owned(), false);
    visit_gradients(&result, moments.n_owned(), [&](const LocalIndex i) { has_gradient[i] = true; });
    NodalVector of_polynomial = numbers_of_nodes(polynomials.graph()), of_node(of_polynomial);
    for (std::size_t f = 0; f < moments.faces().faces().size(); ++f)
      {
        const FaceCells cells = cells_of(f);
        if (std::none_of(cells.begin(), cells.end(), [&](const LocalIndex i) {
              return i < moments.n_owned() && has_gradient[i];
            }))
          continue;
        result.faces.push_back(f);
        for (const LocalIndex i : cells)
          of_polynomial.local_element(i) = 1.;
      }
    result.polynomials = collect_marked(of_polynomial);
    for (const LocalIndex i : result.polynomials)
      {
        if (!has_gradient[i])
          result.without_gradient.push_back(i);
        of_node.local_element(i) = 1.;
        for (BondIndex k = polynomials.first()[i]; k < polynomials.first()[i + 1]; ++k)
          of_node.local_element(polynomials.columns()[k]) = 1.;
      }
    result.nodes        = collect_marked(of_node);
    const auto &entries = moments.prescribed_values().entries();
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (has_gradient[moments.faces().boundary_points()[entries[e].point].node])
        result.entries.push_back(e);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(CellReach)
} // namespace perideal
