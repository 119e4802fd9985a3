// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/cell_steps.h>
#include <perideal/operators/force/consistent_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Green's strain of a gradient in pairs, or the small one.
    template <int dim>
    typename SymmetricPairs<dim>::Pairs strain_of(const dealii::Tensor<2, dim> &gradient, const bool is_small)
    {
      using Symmetric               = SymmetricPairs<dim>;
      dealii::Tensor<2, dim> strain = gradient;
      if (!is_small)
        strain += 0.5 * transpose(gradient) * gradient;
      typename Symmetric::Pairs result;
      for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
        {
          const auto [a, b] = Symmetric::axes(p);
          result[p]         = a == b ? strain[a][a] : strain[a][b] + strain[b][a];
        }
      return result;
    }

    /// Adds forces on supports, of which there may be none yet.
    template <int dim>
    void add_support(const std::vector<dealii::Tensor<1, dim>> &more,
                     std::vector<dealii::Tensor<1, dim>>       &support)
    {
      support.resize(more.size());
      for (std::size_t e = 0; e < more.size(); ++e)
        support[e] += more[e];
    }
  } // namespace

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
  void ConsistentForce<dim>::evaluate(const CellSubset *some) const
  {
    moments->read(last, GradientMoments<dim>::AtFaces::values, some);
    visit_gradients(some, families->n_owned(), [&](const LocalIndex i) {
      bonds->set_state(
        i, *moments->polynomial(i), strain_of(to_tensor<dim>(moments->gradient(i)), has_small_strain));
    });
    if (has_small_strain)
      bonds->sum_small(some);
    else
      bonds->sum_finite(some);
  }

  template <int dim>
  void ConsistentForce<dim>::turn_into_stress(const LocalIndex i, const bool counts) const
  {
    auto deformation = to_tensor<dim>(moments->gradient(i));
    if (has_small_strain)
      deformation = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      deformation[d][d] += 1.;
    const HyperelasticLaw<dim> &law = laws.plain(i);
    if (!counts)
      {
        std::fill_n(moments->gradient(i), dim, NodeRecord{});
        std::fill_n(moments->moment(i), dim * dim, NodeRecord{});
      }
    else if (const PointModulus<dim> *modulus = laws.modulus(i))
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
  void ConsistentForce<dim>::spread(const CellSubset *some)
  {
    const LoopOver<LocalIndex> cells(some ? &some->own : nullptr, families->n_owned());
    for (std::size_t n = 0; n < cells.size(); ++n)
      turn_into_stress(cells[n], true);
    if (some)
      for (const LocalIndex i : some->far_ends)
        turn_into_stress(i, false);
    moments->transpose(added, some);
  }

  template <int dim>
  void ConsistentForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    this->move_nodes(displacement);
    last = displacement;
    evaluate();
    support.clear();
    spread(nullptr);
    add_support(moments->support_forces(), support);
    force.equ(-1., added);
  }

  template <int dim>
  void ConsistentForce<dim>::compute_parts(std::vector<LevelledForce::Part> &parts,
                                           const NodalVector                &displacement,
                                           const unsigned int                highest)
  {
    const auto &steps    = dynamic_cast<const CellSteps &>(*local_steps);
    const bool  is_whole = highest + 1 == steps.n_levels();
    this->move_nodes(displacement, nullptr, is_whole ? nullptr : &steps.moving(highest));
    last = displacement;
    for (unsigned int level = 0; level <= highest; ++level)
      {
        const CellSubset &cells = steps.cells(level);
        evaluate(&cells);
        spread(&cells);
        auto &[force, support_part] = parts[level];
        support_part.clear();
        for (const auto &of_entry : moments->support_forces(&cells))
          support_part.insert(support_part.end(), of_entry.begin_raw(), of_entry.end_raw());
        for (const std::size_t i : cells.nodes)
          for (std::size_t k = dim * i; k < dim * (i + 1); ++k)
            force.local_element(k) = -added.local_element(k);
      }
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
    spread(nullptr);
    add_support(moments->support_forces(), support);
    force -= added;
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
