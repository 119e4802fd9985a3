// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/consistent_force.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  template <int dim>
  ConsistentForce<dim>::ConsistentForce(const std::shared_ptr<const Families<dim>>        &families,
                                        const std::shared_ptr<const GradientMoments<dim>> &moments,
                                        const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                                        const LawsByMaterial<dim>                         &laws)
    : BreakingBonds<dim>(families, bonds->list(), false, false)
    , moments(moments)
    , bonds(bonds)
    , points(std::make_shared<const CellPoints<dim>>(moments->cell_polynomials(), bonds->shares()))
    , laws(*families, laws)
    , has_small_strain(this->laws.are_linear())
  {
    this->initialize(last);
    this->initialize(added);
  }

  template <int dim>
  typename SymmetricPairs<dim>::Pairs
  ConsistentForce<dim>::strain_of(const dealii::Tensor<2, dim> &gradient) const
  {
    using Symmetric               = SymmetricPairs<dim>;
    dealii::Tensor<2, dim> strain = gradient;
    if (!has_small_strain)
      strain += 0.5 * transpose(gradient) * gradient;
    typename Symmetric::Pairs result;
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      {
        const auto [a, b] = Symmetric::axes(p);
        result[p]         = a == b ? strain[a][a] : strain[a][b] + strain[b][a];
      }
    return result;
  }

  template <int dim>
  void ConsistentForce<dim>::evaluate() const
  {
    moments->read(last, GradientMoments<dim>::AtFaces::values);
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      bonds->set_state(i, *moments->polynomial(i), strain_of(to_tensor<dim>(moments->gradient(i))));
    if (has_small_strain)
      bonds->sum_small();
    else
      bonds->sum_finite();
  }

  template <int dim>
  void ConsistentForce<dim>::turn_into_stress(const LocalIndex i) const
  {
    auto deformation = to_tensor<dim>(moments->gradient(i));
    if (has_small_strain)
      deformation = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      deformation[d][d] += 1.;
    const HyperelasticLaw<dim> &law = laws.plain(i);
    if (const PointModulus<dim> *modulus = laws.modulus(i))
      points->turn_into_stress_at_once(
        *moments, i, [&](const unsigned int, const PointTensor<dim, Lanes> &gradient) {
          PointTensor<dim, Lanes> F = gradient, P;
          for (unsigned int d = 0; d < dim; ++d)
            F.entry[d][d] += 1.;
          add_product(F, modulus->stress(green_strain(gradient)), P);
          return P;
        });
    else if (laws.expand_freely())
      points->turn_into_stress(
        *moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          return laws.at(i, points->offset_of(i, p)).stress(gradient);
        });
    else
      points->turn_into_stress(*moments, i, [&](const unsigned int, const dealii::Tensor<2, dim> &gradient) {
        return law.stress(gradient);
      });
    add_columns<dim>(deformation * bonds->stress(i), moments->gradient(i));
    moments->force(i) = bonds->force(i);
  }

  template <int dim>
  void ConsistentForce<dim>::add_force(NodalVector &force)
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      turn_into_stress(i);
    moments->transpose(added);
    force -= added;
    const auto at_faces = moments->support_forces();
    support.resize(at_faces.size());
    for (std::size_t e = 0; e < at_faces.size(); ++e)
      support[e] += at_faces[e];
  }

  template <int dim>
  void ConsistentForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    this->move_nodes(displacement);
    last = displacement;
    evaluate();
    force = 0.;
    support.clear();
    add_force(force);
  }

  template <int dim>
  double ConsistentForce<dim>::change_shares(const std::vector<double> &of_nodes, NodalVector &force)
  {
    // Force and energy are linear in the shares: what changes is that of their change.
    std::vector<double> more(of_nodes);
    for (LocalIndex i = 0; i < more.size(); ++i)
      more[i] -= bonds->share(i);
    bonds->set_shares(more);
    evaluate();
    const double energy = evaluated_energy();
    add_force(force);
    bonds->set_shares(of_nodes);
    return energy;
  }

  template <int dim>
  double ConsistentForce<dim>::strain_energy() const
  {
    evaluate();
    return evaluated_energy();
  }

  template <int dim>
  double ConsistentForce<dim>::evaluated_energy() const
  {
    double result = has_small_strain ? bonds->energy_small() : bonds->energy_finite();
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      if (const double of_point = points->weight(i); of_point != 0.)
        points->visit(*moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          result += of_point * laws.at(i, points->offset_of(i, p)).energy(gradient);
        });
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ConsistentForce<dim>::gradients() const
  {
    moments->read(last, GradientMoments<dim>::AtFaces::values);
    std::vector<dealii::Tensor<2, dim>> result;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      result.push_back(to_tensor<dim>(moments->gradient(i)));
    return result;
  }

  template <int dim>
  std::vector<double> ConsistentForce<dim>::dilatation() const
  {
    std::vector<double> result;
    for (const auto &gradient : gradients())
      result.push_back(trace(gradient));
    return result;
  }

  template <int dim>
  std::size_t ConsistentForce<dim>::memory_consumption() const
  {
    return this->breaking_memory() + points->memory_consumption() + 2 * last.memory_consumption() +
           laws.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentForce)
} // namespace perideal
