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
    , states(families.n_owned())
    , modulus_of(families.n_owned())
  {
    force.evaluate();
    of_bonds = bonds->linearise();
    deformations.resize(dim * families.n_local(), NodeRecord{});
    // That of all points of a cell; null where they have each their own.
    const auto constant_modulus = [&](const LocalIndex i) {
      const auto *modulus = force.law_at(i, 0).constant_modulus();
      for (unsigned int p = 1; p < CellPoints<dim>::n; ++p)
        if (force.law_at(i, p).constant_modulus() != modulus)
          modulus = nullptr;
      return modulus;
    };
    std::map<const dealii::SymmetricTensor<4, dim> *, std::size_t> constant;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (const auto *modulus = constant_modulus(i);
          modulus != nullptr && constant.emplace(modulus, moduli.size()).second)
        moduli.push_back(pack(*modulus));
    n_constant = moduli.size();
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        add_columns<dim>(dealii::unit_symmetric_tensor<dim>(), deformations.data() + dim * i);
        add_columns(to_tensor<dim>(moments->gradient(i)), deformations.data() + dim * i);
        bond_stress[i]   = bonds->stress(i);
        const auto known = constant.find(constant_modulus(i));
        modulus_of[i]    = known != constant.end() ? known->second : moduli.size();
        points->visit(*moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          const auto law   = force.law_at(i, p);
          Point     &point = states[i][p];
          const auto unit  = dealii::unit_symmetric_tensor<dim>();
          const auto F     = gradient + dealii::Tensor<2, dim>(unit);
          // The inverse is not asked for where S follows from the strain: a cell may be flat.
          const auto S = known != constant.end() ?
                           *known->first * (0.5 * (symmetrize(transpose(F) * F) - unit)) :
                           symmetrize(invert(F) * law.stress(gradient));
          for (unsigned int e = 0; e < dim * dim; ++e)
            point.gradient[e] = gradient[e / dim][e % dim];
          for (unsigned int q = 0; q < Symmetric::n_pairs; ++q)
            point.stress[q] = S[Symmetric::axes(q).first][Symmetric::axes(q).second];
          if (known == constant.end())
            moduli.push_back(pack(law, gradient));
        });
      }
    std::vector<double> buffer;
    update_ghosts(*families.make_partitioner(4 * dim), deformations, buffer);
  }

  template <int dim>
  typename DeformedCells<dim>::Modulus
  DeformedCells<dim>::pack(const dealii::SymmetricTensor<4, dim> &modulus)
  {
    Modulus result;
    auto    next = result.begin();
    for (unsigned int r = 0; r < Symmetric::n_pairs; ++r)
      for (unsigned int c = 0; c <= r; ++c)
        {
          const auto [a, b] = Symmetric::axes(r);
          const auto [k, l] = Symmetric::axes(c);
          *next++           = modulus[a][b][k][l];
        }
    return result;
  }

  template <int dim>
  typename DeformedCells<dim>::Modulus DeformedCells<dim>::pack(const HyperelasticLaw<dim>   &law,
                                                                const dealii::Tensor<2, dim> &gradient)
  {
    // dS/dE = F^-1 (dP/dF - I S) F^-T on the first index of each pair.
    const dealii::Tensor<2, dim> inverse =
      invert(gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()));
    const dealii::Tensor<2, dim> S = inverse * law.stress(gradient);
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
    return pack(modulus);
  }

  template <int dim>
  dealii::Tensor<2, dim> DeformedCells<dim>::change_of_stress(const LocalIndex              i,
                                                              const unsigned int            p,
                                                              const dealii::Tensor<2, dim> &gradient) const
  {
    const Point           &point = states[i][p];
    dealii::Tensor<2, dim> F;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        F[k][l] = (k == l ? 1. : 0.) + point.gradient[dim * k + l];
    const std::size_t number = modulus_of[i] + (modulus_of[i] < n_constant ? 0 : p);
    const double     *entry  = moduli[number].data();
    Pairs             strain, stress = {};
    for (unsigned int q = 0; q < Symmetric::n_pairs; ++q)
      {
        const auto [a, b] = Symmetric::axes(q);
        double sum        = 0;
        for (int k = 0; k < dim; ++k)
          sum += a == b ? F[k][a] * gradient[k][a] : F[k][a] * gradient[k][b] + F[k][b] * gradient[k][a];
        strain[q] = sum;
      }
    for (unsigned int r = 0; r < Symmetric::n_pairs; ++r)
      {
        for (unsigned int c = 0; c < r; ++c, ++entry)
          {
            stress[r] += *entry * strain[c];
            stress[c] += *entry * strain[r];
          }
        stress[r] += *entry++ * strain[r];
      }
    dealii::Tensor<2, dim> result;
    for (unsigned int q = 0; q < Symmetric::n_pairs; ++q)
      {
        const auto [a, b] = Symmetric::axes(q);
        for (int k = 0; k < dim; ++k)
          {
            result[k][b] += F[k][a] * stress[q] + gradient[k][a] * point.stress[q];
            if (a != b)
              result[k][a] += F[k][b] * stress[q] + gradient[k][b] * point.stress[q];
          }
      }
    return result;
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
        points->turn_into_stress(
          *moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
            return change_of_stress(i, p, gradient);
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
          const auto stress = points->weight(i) * change_of_stress(i, p, gradient);
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
    return states.size() * sizeof(states[0]) + moduli.size() * sizeof(moduli[0]) +
           modulus_of.size() * sizeof(std::size_t) + bond_stress.size() * sizeof(bond_stress[0]) +
           (deformations.size() + of_bonds.position.size()) * sizeof(NodeRecord) +
           of_bonds.tension.size() * sizeof(double);
  }

  PERIDEAL_INSTANTIATE_CLASS(DeformedCells)
} // namespace perideal
