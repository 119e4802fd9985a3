// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/weights/consistent_bonds.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <map>

namespace perideal
{
  namespace
  {
    /// xi (x) xi of a bond, as in a PairRecord.
    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 1> &products)
    {
      products[0] =
        __builtin_shufflevector(bond, bond, 0, 1, 0, 3) * __builtin_shufflevector(bond, bond, 0, 1, 1, 3);
    }

    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 2> &products)
    {
      products[0] = bond * bond;
      products[1] = bond * __builtin_shufflevector(bond, bond, 1, 2, 0, 3);
    }
  } // namespace

  template <int dim>
  ConsistentBonds<dim>::ConsistentBonds(const std::shared_ptr<const Families<dim>> &families,
                                        const CellPolynomials<dim>                 &polynomials,
                                        const Consistent<dim>                      &model,
                                        const SolidOf<dim>                         &solid_of,
                                        const BondPredicate<dim>                   &is_cut)
    : families(families)
    , bonds(*families)
    , of_states(families->make_partitioner(4 * n_records))
  {
    const LocalIndex n_local = families->n_local();
    work.states.resize(n_records * n_local, NodeRecord{});
    work.forces.resize(n_local, NodeRecord{});
    work.stresses.resize(n_parts * n_local, NodeRecord{});

    // Centroids of the ghosts, which their owners know.
    const auto &centroids = polynomials.centroids();
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        work.states[n_records * i].value[d] = centroids[i][d];
    update_ghosts();
    position.resize(n_local, NodeRecord{});
    for (LocalIndex i = 0; i < n_local; ++i)
      position[i] = work.states[n_records * i];
    weigh(model, solid_of, is_cut);
  }

  template <int dim>
  void ConsistentBonds<dim>::weigh(const Consistent<dim>    &model,
                                   const SolidOf<dim>       &solid_of,
                                   const BondPredicate<dim> &is_cut)
  {
    stiffness_of.assign(bonds.n_slots(), 0.);
    std::map<dealii::types::material_id, double> modulus_of;
    for (const auto id : families->material)
      if (modulus_of.count(id) == 0)
        modulus_of[id] = Consistent<dim>::stabilising_modulus(solid_of(id));
    // Their horizon is what the families list, however far those of breaking bonds reach.
    const double listed_square   = families->listed() * families->listed();
    const auto   distance_square = [&](const LocalIndex m, const dealii::Tensor<1, dim> &bond) {
      return (families->shape.empty() ? bond.norm_square() / (families->horizon[m] * families->horizon[m]) :
                                          (families->shape[m] * bond).norm_square()) /
             listed_square;
    };
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        {
          const LocalIndex j = bonds.neighbour[k];
          if (j == i || families->material[j] != families->material[i] ||
              (is_cut && is_cut(families->position[i], families->position[j])))
            continue;
          const auto   bond          = families->position[j] - families->position[i];
          const double length_square = bond.norm_square(), modulus = modulus_of[families->material[i]];
          stiffness_of[k] =
            model.bond_stiffness(length_square, distance_square(i, bond), families->volume[j], modulus) +
            model.bond_stiffness(length_square, distance_square(j, bond), families->volume[i], modulus);
        }
  }

  template <int dim>
  void ConsistentBonds<dim>::set_shares(const std::vector<double> &of_nodes)
  {
    if (whole_stiffness.empty())
      whole_stiffness = stiffness_of;
    shares_of_cells->set(of_nodes);
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        stiffness_of[k] = shares_of_cells->of_bond(i, bonds.neighbour[k]) * whole_stiffness[k];
  }

  template <int dim>
  void ConsistentBonds<dim>::update_ghosts()
  {
    perideal::update_ghosts(*of_states, work.states, work.buffer);
  }

  template <int dim>
  template <typename ConsistentBonds<dim>::Kinematics kinematics>
  void ConsistentBonds<dim>::sum(const Linearisation *at, const CellSubset *some)
  {
    using Parts                    = std::array<Lanes, n_parts>;
    constexpr unsigned int n_lanes = BondList::n_lanes;
    const NodeRecord      *x = position.data(), *state = work.states.data();
    NodeRecord            *f = work.forces.data(), *stress = work.stresses.data();
    const NodeRecord      *deformed = kinematics == Kinematics::change ? at->position.data() : nullptr;
    const auto             clear    = [&](const LocalIndex first, const LocalIndex last) {
      std::fill(f + first, f + last, NodeRecord{});
      std::fill(stress + n_parts * first, stress + n_parts * last, NodeRecord{});
    };
    if (some)
      for (const auto *cells : {&some->own, &some->far_ends})
        for (const LocalIndex i : *cells)
          clear(i, i + 1);
    clear(some ? families->n_owned() : 0, families->n_local());

    const LoopOver<LocalIndex> rows(some ? &some->own : nullptr, families->n_owned());
    for (std::size_t n = 0; n < rows.size(); ++n)
      {
        const LocalIndex  i    = rows[n];
        const NodeRecord *near = state + n_records * i;
        const Lanes       xi = lanes(x[i]), ui    = lanes(near[0]);
        Parts             near_strain, own_stress = {};
        for (unsigned int p = 0; p < n_parts; ++p)
          near_strain[p] = lanes(near[1 + p]);
        Lanes own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += n_lanes)
          {
            const LocalIndex *j = bonds.neighbour.data() + k;
            // A bond's relative displacement and the direction of its pull.
            Lanes direction[n_lanes], moved[n_lanes], part[n_lanes];
            Parts square[n_lanes];
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                const NodeRecord *far  = state + n_records * j[l];
                const Lanes       bond = lanes(x[j[l]]) - xi;
                moved[l]               = lanes(far[0]) - ui;
                direction[l]           = bond;
                multiply_out(bond, square[l]);
                if (kinematics == Kinematics::change)
                  direction[l] = lanes(deformed[j[l]]) - lanes(deformed[i]);
                part[l] =
                  (kinematics == Kinematics::finite ? bond + 0.5 * moved[l] : direction[l]) * moved[l];
                if (kinematics == Kinematics::finite)
                  direction[l] += moved[l];
                for (unsigned int p = 0; p < n_parts; ++p)
                  part[l] -= 0.5 * (near_strain[p] + lanes(far[1 + p])) * square[l][p];
              }
            Lanes pull, factor;
            sum_of_each(pull, part[0], part[1], part[2], part[3]);
            load(factor, stiffness_of.data() + k);
            pull *= factor;
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                Lanes force = pull[l] * direction[l];
                if (kinematics == Kinematics::change)
                  force += at->tension[k + l] * moved[l];
                own -= force;
                lanes(f[j[l]]) += force;
                NodeRecord *of_far = stress + n_parts * j[l];
                for (unsigned int p = 0; p < n_parts; ++p)
                  {
                    const Lanes change = (0.5 * pull[l]) * square[l][p];
                    own_stress[p] -= change;
                    lanes(of_far[p]) -= change;
                  }
              }
          }
        lanes(f[i]) += own;
        for (unsigned int p = 0; p < n_parts; ++p)
          lanes(stress[n_parts * i + p]) += own_stress[p];
      }
  }

  template <int dim>
  void ConsistentBonds<dim>::sum_small(const CellSubset *some)
  {
    update_ghosts();
    sum<Kinematics::small>(nullptr, some);
  }

  template <int dim>
  void ConsistentBonds<dim>::sum_finite(const CellSubset *some)
  {
    update_ghosts();
    sum<Kinematics::finite>(nullptr, some);
  }

  template <int dim>
  typename ConsistentBonds<dim>::Linearisation ConsistentBonds<dim>::linearise() const
  {
    Linearisation result;
    result.tension.assign(bonds.n_slots(), 0.);
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        if (stiffness_of[k] != 0.)
          result.tension[k] = stiffness_of[k] * residual(i, bonds.neighbour[k], true);
    result.position.resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i)
      lanes(result.position[i]) = lanes(position[i]) + lanes(work.states[n_records * i]);
    return result;
  }

  template <int dim>
  void ConsistentBonds<dim>::sum_changes(const Linearisation &at)
  {
    update_ghosts();
    sum<Kinematics::change>(&at, nullptr);
  }

  template <int dim>
  double ConsistentBonds<dim>::residual(const LocalIndex i, const LocalIndex j, const bool is_finite) const
  {
    const NodeRecord *near = work.states.data() + n_records * i, *far = work.states.data() + n_records * j;
    const NodeRecord *near_strain = near + 1, *far_strain = far + 1;
    const auto        along  = bond(i, j);
    const Pairs       square = Symmetric::products(along);
    double            r      = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double moved = far->value[d] - near->value[d];
        r += (along[d] + (is_finite ? 0.5 * moved : 0.)) * moved;
      }
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      r -= 0.5 * square[p] * (Symmetric::pair(near_strain, p) + Symmetric::pair(far_strain, p));
    return r;
  }

  template <int dim>
  double ConsistentBonds<dim>::energy(const bool is_finite) const
  {
    double result = 0;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        {
          if (stiffness_of[k] == 0.)
            continue;
          const LocalIndex j = bonds.neighbour[k];
          const double     r = residual(i, j, is_finite);
          result += (j < families->n_owned() ? 0.5 : 0.25) * stiffness_of[k] * r * r;
        }
    return result;
  }

  template <int dim>
  std::size_t ConsistentBonds<dim>::memory_consumption() const
  {
    return bonds.memory_consumption() + dealii::MemoryConsumption::memory_consumption(stiffness_of) +
           dealii::MemoryConsumption::memory_consumption(whole_stiffness) +
           shares_of_cells->memory_consumption() +
           (position.size() + work.states.size() + work.forces.size() + work.stresses.size()) *
             sizeof(NodeRecord);
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentBonds)
} // namespace perideal
