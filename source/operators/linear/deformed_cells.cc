// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/linear/deformed_cells.h>

#include <map>

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
    , changes(families.n_owned())
    , modulus_of(families.n_owned())
  {
    const LawsOfNodes<dim> &laws = force.laws_of_nodes();
    force.evaluate();
    of_bonds = bonds->linearise();
    deformations.resize(dim * families.n_local(), NodeRecord{});
    std::map<const PointModulus<dim> *, std::uint32_t> number;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (const auto *modulus = laws.modulus(i);
          modulus != nullptr && number.emplace(modulus, moduli.size()).second)
        moduli.push_back(*modulus);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        add_columns<dim>(dealii::unit_symmetric_tensor<dim>(), deformations.data() + dim * i);
        add_columns(to_tensor<dim>(moments->gradient(i)), deformations.data() + dim * i);
        bond_stress[i] = bonds->stress(i);
        if (const auto *modulus = laws.modulus(i))
          {
            modulus_of[i] = number.at(modulus);
            keep_changes(i);
            continue;
          }
        modulus_of[i] = moduli.size() + of_other_laws.size();
        of_other_laws.emplace_back();
        points->visit(*moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          of_other_laws.back().push_back(make_point(laws.at(i, points->offset_of(i, p)), gradient));
        });
      }
    std::vector<double> buffer;
    update_ghosts(*families.make_partitioner(4 * dim), deformations, buffer);
  }

  template <int dim>
  void DeformedCells<dim>::keep_changes(const LocalIndex i)
  {
    const PointLanes<dim> at_once = PointLanes<dim>(points->offsets(i));
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int l = 0; l < dim; ++l)
        {
          const Lanes change = at_once.above_mean(
            [&](const unsigned int m) { return moments->moment(i)[dim * m + l].value[a]; });
          for (unsigned int k = 0; k < dim; ++k)
            changes[i][dim * (dim * a + l) + k] = static_cast<float>(change[k]);
        }
  }

  template <int dim>
  typename DeformedCells<dim>::Point DeformedCells<dim>::make_point(const HyperelasticLaw<dim>   &law,
                                                                    const dealii::Tensor<2, dim> &gradient)
  {
    // dS/dE = F^-1 (dP/dF - I S) F^-T on the first index of each pair.
    const dealii::Tensor<2, dim> F = gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    const dealii::Tensor<2, dim> inverse = invert(F), S = inverse * law.stress(gradient);
    dealii::Tensor<4, dim>       A = law.tangent(gradient);
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        for (int L = 0; L < dim; ++L)
          A[i][J][i][L] -= S[J][L];
    dealii::SymmetricTensor<4, dim> modulus;
    for (int I = 0; I < dim; ++I)
      for (int J = I; J < dim; ++J)
        for (int K = 0; K < dim; ++K)
          for (int L = K; L < dim; ++L)
            {
              double sum = 0;
              for (int i = 0; i < dim; ++i)
                for (int k = 0; k < dim; ++k)
                  sum += inverse[I][i] * A[i][J][k][L] * inverse[K][k];
              modulus[I][J][K][L] = sum;
            }
    Point result{{}, {}, PointModulus<dim>(modulus)};
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        result.deformation.entry[k][l] = F[k][l];
    for (unsigned int q = 0; q < Symmetric::n_pairs; ++q)
      {
        const auto [a, b]     = Symmetric::axes(q);
        result.stress.pair[q] = 0.5 * (S[a][b] + S[b][a]);
      }
    return result;
  }

  template <int dim>
  template <typename Number>
  PointTensor<dim, Number> DeformedCells<dim>::change_of_stress(const PointModulus<dim>        &modulus,
                                                                const PointTensor<dim, Number> &deformation,
                                                                const PointPairs<dim, Number>  &stress,
                                                                const PointTensor<dim, Number> &change)
  {
    PointTensor<dim, Number> result;
    add_product(deformation, modulus.stress(change_of_strain(deformation, change)), result);
    add_product(change, stress, result);
    return result;
  }

  template <int dim>
  void DeformedCells<dim>::turn_into_stress(const LocalIndex i, const PointModulus<dim> &modulus) const
  {
    PointTensor<dim, Lanes> F[2];
    PointLanes<dim>::combine(
      [&](const unsigned int a, const unsigned int l) { return deformations[dim * i + l].value[a]; },
      [&](const unsigned int a, const unsigned int l) {
        Lanes result;
        load(result, changes[i].data() + dim * (dim * a + l));
        return result;
      },
      F[0],
      F[1]);
    points->turn_into_stress_at_once(
      *moments, i, [&](const unsigned int side, const PointTensor<dim, Lanes> &change) {
        PointTensor<dim, Lanes> gradient = F[side];
        for (unsigned int d = 0; d < dim; ++d)
          gradient.entry[d][d] -= 1.;
        return change_of_stress(modulus, F[side], modulus.stress(green_strain(gradient)), change);
      });
  }

  template <int dim>
  void DeformedCells<dim>::sum_over_bonds() const
  {
    for (LocalIndex i = 0; i < moments->n_owned(); ++i)
      {
        const auto change = transpose(deformation(i)) * to_tensor<dim>(moments->gradient(i));
        Pairs      strain;
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
        if (modulus_of[i] < moduli.size())
          turn_into_stress(i, moduli[modulus_of[i]]);
        else
          {
            const Points &states = of_other_laws[modulus_of[i] - moduli.size()];
            points->turn_into_stress(
              *moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
                return change_of_stress(states[p], gradient);
              });
          }
        add_columns<dim>(deformation(i) * bonds->stress(i) + change * bond_stress[i], moments->gradient(i));
        moments->force(i) = bonds->force(i);
      }
  }

  template <int dim>
  dealii::Tensor<2, dim> DeformedCells<dim>::change_of_stress(const Point                  &point,
                                                              const dealii::Tensor<2, dim> &gradient)
  {
    PointTensor<dim, double> change;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        change.entry[k][l] = gradient[k][l];
    const auto             stress = change_of_stress(point.modulus, point.deformation, point.stress, change);
    dealii::Tensor<2, dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        result[k][l] = stress.entry[k][l];
    return result;
  }

  template <int dim>
  typename DeformedCells<dim>::Points DeformedCells<dim>::points_of(const LocalIndex i) const
  {
    if (modulus_of[i] >= moduli.size())
      return of_other_laws[modulus_of[i] - moduli.size()];
    const PointModulus<dim> &modulus = moduli[modulus_of[i]];
    Points                   result;
    for (unsigned int p = 0; p < CellPoints<dim>::n; ++p)
      {
        PointTensor<dim, double> F, G;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int l = 0; l < dim; ++l)
            {
              const double change = changes[i][dim * (dim * a + l) + p / 2];
              F.entry[a][l]       = deformations[dim * i + l].value[a] + (p % 2 == 0 ? change : -change);
              G.entry[a][l]       = F.entry[a][l] - (a == l ? 1. : 0.);
            }
        result.push_back({F, modulus.stress(green_strain(G)), modulus});
      }
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<4, dim>> DeformedCells<dim>::weighted_moduli(const LocalIndex i) const
  {
    std::vector<dealii::Tensor<4, dim>> result;
    for (const Point &point : points_of(i))
      {
        result.emplace_back();
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int n = 0; n < dim; ++n)
            {
              dealii::Tensor<2, dim> gradient;
              gradient[b][n]    = points->weight(i);
              const auto stress = change_of_stress(point, gradient);
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int l = 0; l < dim; ++l)
                  result.back()[a][l][b][n] = stress[a][l];
            }
      }
    return result;
  }

  template <int dim>
  dealii::Tensor<2, dim> DeformedCells<dim>::block_of(const LocalIndex                           i,
                                                      const std::vector<dealii::Tensor<4, dim>> &at_points,
                                                      const Row                                 &row,
                                                      const std::size_t                          k,
                                                      const std::size_t                          m) const
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
      {
        std::array<dealii::Tensor<1, dim>, dim> near, far;
        for (unsigned int a = 0; a < dim; ++a)
          {
            near[a] = at_point(k, a, p);
            far[a]  = k == m ? near[a] : at_point(m, a, p);
          }
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int l = 0; l < dim; ++l)
            for (unsigned int b = 0; b < dim; ++b)
              result[a][b] += near[a][l] * (at_points[p][a][l][b] * far[b]);
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
    return changes.size() * sizeof(changes[0]) + moduli.size() * sizeof(moduli[0]) +
           modulus_of.size() * sizeof(std::uint32_t) + bond_stress.size() * sizeof(bond_stress[0]) +
           of_other_laws.size() * (sizeof(Points) + CellPoints<dim>::n * sizeof(Point)) +
           (deformations.size() + of_bonds.position.size()) * sizeof(NodeRecord) +
           of_bonds.tension.size() * sizeof(double);
  }

  PERIDEAL_INSTANTIATE_CLASS(DeformedCells)
} // namespace perideal
