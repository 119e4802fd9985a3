// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/linear/deformed_cells.h>

namespace perideal
{
  template <int dim>
  DeformedCells<dim>::DeformedCells(const Families<dim>                               &families,
                                    const std::shared_ptr<const GradientMoments<dim>> &moments,
                                    const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                                    const ConsistentForce<dim>                        &force)
    : moments(moments)
    , bonds(bonds)
    , points(force.cell_points())
    , bond_stress(families.n_owned())
    , moduli(families.n_owned())
  {
    force.evaluate();
    of_bonds = bonds->linearise();
    deformations.resize(dim * families.n_local(), NodeRecord{});
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        add_columns<dim>(dealii::unit_symmetric_tensor<dim>(), deformations.data() + dim * i);
        add_columns(to_tensor<dim>(moments->gradient(i)), deformations.data() + dim * i);
        bond_stress[i] = bonds->stress(i);
        points->visit(*moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          moduli[i][p] = pack(force.law_at(i, p).tangent(gradient));
        });
      }
    std::vector<double> buffer;
    update_ghosts(*families.make_partitioner(4 * dim), deformations, buffer);
  }

  template <int dim>
  typename DeformedCells<dim>::Moduli DeformedCells<dim>::pack(const dealii::Tensor<4, dim> &tangent)
  {
    Moduli result;
    auto   next = result.begin();
    for (unsigned int r = 0; r < n_entries; ++r)
      for (unsigned int c = 0; c <= r; ++c)
        *next++ = tangent[r / dim][r % dim][c / dim][c % dim];
    return result;
  }

  template <int dim>
  dealii::Tensor<2, dim> DeformedCells<dim>::multiply(const Moduli                 &moduli,
                                                      const dealii::Tensor<2, dim> &gradient)
  {
    std::array<double, n_entries> from, to = {};
    for (unsigned int r = 0; r < n_entries; ++r)
      from[r] = gradient[r / dim][r % dim];
    auto next = moduli.begin();
    for (unsigned int r = 0; r < n_entries; ++r)
      {
        for (unsigned int c = 0; c < r; ++c, ++next)
          {
            to[r] += *next * from[c];
            to[c] += *next * from[r];
          }
        to[r] += *next++ * from[r];
      }
    dealii::Tensor<2, dim> result;
    for (unsigned int r = 0; r < n_entries; ++r)
      result[r / dim][r % dim] = to[r];
    return result;
  }

  template <int dim>
  void DeformedCells<dim>::sum_over_bonds() const
  {
    using Symmetric = SymmetricPairs<dim>;
    for (LocalIndex i = 0; i < moments->n_owned(); ++i)
      {
        const auto                change = transpose(deformation(i)) * to_tensor<dim>(moments->gradient(i));
        typename Symmetric::Pairs strain;
        for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
          {
            const auto [a, b] = Symmetric::axes(p);
            strain[p]         = a == b ? change[a][a] : change[a][b] + change[b][a];
          }
        bonds->set_state(i, *moments->polynomial(i), strain);
      }
    bonds->sum_changes(of_bonds);
  }

  template <int dim>
  void DeformedCells<dim>::turn_into_stress() const
  {
    for (LocalIndex i = 0; i < moments->n_owned(); ++i)
      {
        const auto change = to_tensor<dim>(moments->gradient(i));
        points->turn_into_stress(
          *moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
            return multiply(moduli[i][p], gradient);
          });
        add_columns<dim>(deformation(i) * bonds->stress(i) + change * bond_stress[i], moments->gradient(i));
        moments->force(i) = bonds->force(i);
      }
  }

  template <int dim>
  dealii::Tensor<2, dim> DeformedCells<dim>::block_of(const LocalIndex  i,
                                                      const Row        &row,
                                                      const std::size_t k,
                                                      const std::size_t m) const
  {
    const auto q = points->offsets(i);
    // The gradient at a point that one of a column's components makes.
    const auto at_point = [&](const std::size_t column, const unsigned int a, const unsigned int p) {
      const double                 sign   = p % 2 == 0 ? 1. : -1.;
      const dealii::Tensor<2, dim> moment = row.moment_of(a)[column];
      dealii::Tensor<1, dim>       result = row.gradient_of(a)[column];
      for (unsigned int n = 0; n < dim; ++n)
        result += sign * q[p / 2][n] * moment[n];
      return result;
    };
    dealii::Tensor<2, dim> result;
    for (unsigned int p = 0; p < CellPoints<dim>::n; ++p)
      for (unsigned int b = 0; b < dim; ++b)
        {
          dealii::Tensor<2, dim> gradient;
          gradient[b]       = at_point(m, b, p);
          const auto stress = points->weight(i) * multiply(moduli[i][p], gradient);
          for (unsigned int a = 0; a < dim; ++a)
            result[a][b] += stress[a] * at_point(k, a, p);
        }
    for (unsigned int a = 0; a < dim; ++a)
      result[a][a] += row.gradient_of(a)[k] * (bond_stress[i] * row.gradient_of(a)[m]);
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> DeformedCells<dim>::bond(const LocalIndex i, const LocalIndex j) const
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = of_bonds.position[j].value[d] - of_bonds.position[i].value[d];
    return result;
  }

  template <int dim>
  std::size_t DeformedCells<dim>::memory_consumption() const
  {
    return moduli.size() * sizeof(moduli[0]) + bond_stress.size() * sizeof(bond_stress[0]) +
           (deformations.size() + of_bonds.position.size()) * sizeof(NodeRecord) +
           of_bonds.tension.size() * sizeof(double);
  }

  PERIDEAL_INSTANTIATE_CLASS(DeformedCells)
} // namespace perideal
