// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/operators/bond_operator.h>
#include <perideal/operators/lanes.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace perideal
{
  namespace
  {
    /**
     * The loop for models of one family shape. A bond stores, for each sum, the
     * weight of either end, and one stiffness; its vector is recomputed from
     * the positions, which is faster than loading it.
     */
    template <int dim, unsigned int n_sums, bool own_force_weights>
    class FamilyOperator : public BondOperator<dim>
    {
    public:
      FamilyOperator(const std::shared_ptr<const Families<dim>>                    &families,
                     LinearModel<dim>                                              &model,
                     const std::function<Moduli(const dealii::types::material_id)> &moduli);

      void vmult(NodalVector &force, const NodalVector &displacement) const override;
      std::vector<dealii::Tensor<2, dim>> diagonal_blocks() const override;
      void                       assemble(const typename BondOperator<dim>::AddBlock &add) const override;
      const std::vector<double> &dilatation() const override { return sums[0]; }
      bool                       is_symmetric() const override { return symmetric; }
      std::size_t                memory_consumption() const override;

    private:
      /// Values of the two ends of every bond, by slot.
      struct Ends
      {
        std::vector<double> near, far;
      };
      using Weights = std::array<Ends, n_sums>;

      void weigh_families(LinearModel<dim>                                              &model,
                          const std::function<Moduli(const dealii::types::material_id)> &moduli);
      void store(const LocalIndex                    i,
                 const FamilyCoefficients           &coefficients,
                 const std::vector<BondCursor::End> &ends);
      void import_displacement(const NodalVector &displacement) const;
      void sum_over_families() const;
      void turn_sums_into_states() const;
      void sum_forces() const;

      const Weights &force_weights() const
      {
        if constexpr (own_force_weights)
          return force_weight;
        else
          return sum_weight;
      }

      dealii::Tensor<1, dim> bond_vector(const LocalIndex i, const LocalIndex j) const
      {
        return families->position[j] - families->position[i];
      }

      /// map s, the states of a node from its sums.
      std::array<double, n_sums> states(const LocalIndex i, const std::array<double, n_sums> &s) const;

      std::shared_ptr<const Families<dim>> families;
      BondList                             bonds;
      bool                                 symmetric;

      Weights             sum_weight;
      Weights             force_weight;
      std::vector<double> stiffness;
      /// Map from sums to states by local node (ghosts included for the diagonal).
      std::vector<std::array<double, 3>> map;

      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> state_partitioner;

      // Work space of vmult().
      dealii::AlignedVector<NodeRecord>               positions;
      mutable dealii::AlignedVector<NodeRecord>       displacements, forces;
      mutable std::array<std::vector<double>, n_sums> sums;
      mutable std::array<std::vector<double>, n_sums> state;
      mutable NodalVector                             ghosted, ghosted_states;
    };

    template <int dim, unsigned int n_sums, bool own_force_weights>
    FamilyOperator<dim, n_sums, own_force_weights>::FamilyOperator(
      const std::shared_ptr<const Families<dim>>                    &families,
      LinearModel<dim>                                              &model,
      const std::function<Moduli(const dealii::types::material_id)> &moduli)
      : families(families)
      , bonds(*families)
      , symmetric(model.is_symmetric())
    {
      this->partitioner = families->make_partitioner(dim);
      state_partitioner = families->make_partitioner(n_sums);
      ghosted.reinit(this->partitioner);
      ghosted_states.reinit(state_partitioner);
      weigh_families(model, moduli);

      positions.resize(families->n_local(), NodeRecord{});
      displacements.resize(families->n_local(), NodeRecord{});
      forces.resize(families->n_local(), NodeRecord{});
      for (LocalIndex i = 0; i < families->n_local(); ++i)
        for (int d = 0; d < dim; ++d)
          positions[i].value[d] = families->position[i][d];
      for (unsigned int a = 0; a < n_sums; ++a)
        {
          sums[a].resize(families->n_local());
          state[a].resize(families->n_local());
        }
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::weigh_families(
      LinearModel<dim> &model, const std::function<Moduli(const dealii::types::material_id)> &moduli)
    {
      const BondIndex n = bonds.n_slots();
      stiffness.assign(n, 0.);
      for (Weights *weights : {&sum_weight, &force_weight})
        if (weights == &sum_weight || own_force_weights)
          for (Ends &ends : *weights)
            {
              ends.near.assign(n, 0.);
              ends.far.assign(n, 0.);
            }
      map.resize(families->n_local());
      this->reports.resize(families->n_owned());

      BondCursor                   cursor(bonds);
      std::vector<BondCursor::End> ends;
      FamilyView<dim>              view;
      FamilyCoefficients           coefficients;
      for (LocalIndex i = 0; i < families->n_owned(); ++i)
        {
          view.reinit(*families, i);
          const Moduli material = moduli(families->material[i]);
          view.bulk_modulus     = material.bulk_modulus;
          view.shear_modulus    = material.shear_modulus;
          coefficients.resize(view.size, model.shape());
          model.compute(view, coefficients);
          cursor.find(i, families->begin(i), families->end(i), ends);
          store(i, coefficients, ends);
        }

      // The far ends of cut bonds, and the maps of ghosts, come from their owners.
      std::vector<double>         far_stiffness(n, 0.);
      std::vector<const double *> near = {stiffness.data()};
      std::vector<double *>       far  = {far_stiffness.data()};
      for (Weights *weights : {&sum_weight, &force_weight})
        if (weights == &sum_weight || own_force_weights)
          for (Ends &end_values : *weights)
            {
              near.push_back(end_values.near.data());
              far.push_back(end_values.far.data());
            }
      exchange_cut_bonds(*families, bonds, near, far);
      for (BondIndex slot = 0; slot < n; ++slot)
        stiffness[slot] += far_stiffness[slot];

      NodalVector maps(families->make_partitioner(3));
      for (LocalIndex i = 0; i < families->n_owned(); ++i)
        for (unsigned int k = 0; k < 3; ++k)
          maps.local_element(3 * i + k) = map[i][k];
      maps.update_ghost_values();
      for (LocalIndex i = families->n_owned(); i < families->n_local(); ++i)
        for (unsigned int k = 0; k < 3; ++k)
          map[i][k] = maps.local_element(3 * i + k);

      for (const FamilyReport &report : this->reports)
        {
          this->counts.fallback += report.fallback;
          this->counts.singular += report.singular;
          this->counts.indefinite += report.indefinite;
        }
      for (GlobalIndex *count : {&this->counts.fallback, &this->counts.singular, &this->counts.indefinite})
        *count = dealii::Utilities::MPI::sum(*count, families->communicator);
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::store(const LocalIndex          i,
                                                               const FamilyCoefficients &coefficients,
                                                               const std::vector<BondCursor::End> &ends)
    {
      map[i]           = coefficients.map;
      this->reports[i] = coefficients.report;
      for (std::size_t k = 0; k < ends.size(); ++k)
        {
          const BondCursor::End end = ends[k];
          stiffness[end.slot] += coefficients.stiffness[k];
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              (end.is_near ? sum_weight[a].near : sum_weight[a].far)[end.slot] = coefficients.sum[a][k];
              if constexpr (own_force_weights)
                (end.is_near ? force_weight[a].near : force_weight[a].far)[end.slot] =
                  coefficients.force_weight[a][k];
            }
        }
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void
    FamilyOperator<dim, n_sums, own_force_weights>::import_displacement(const NodalVector &displacement) const
    {
      const NodalVector *source = &displacement;
      if (families->n_local() > families->n_owned())
        {
          std::copy(displacement.begin(), displacement.end(), ghosted.begin());
          ghosted.update_ghost_values();
          source = &ghosted;
        }
      for (LocalIndex i = 0; i < families->n_local(); ++i)
        for (int d = 0; d < dim; ++d)
          displacements[i].value[d] = source->local_element(dim * i + d);
      ghosted.zero_out_ghost_values();
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::sum_over_families() const
    {
      for (unsigned int a = 0; a < n_sums; ++a)
        std::fill(sums[a].begin(), sums[a].end(), 0.);
      const LocalIndex *neighbour = bonds.neighbour.data();
      const NodeRecord *x = positions.data(), *u = displacements.data();

      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        {
          const Lanes xi = lanes(x[i]), ui = lanes(u[i]);
          Lanes       own[n_sums] = {};
          for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
            {
              const LocalIndex *j = neighbour + k;
              Lanes             extension;
              sum_of_each(extension,
                          (lanes(x[j[0]]) - xi) * (lanes(u[j[0]]) - ui),
                          (lanes(x[j[1]]) - xi) * (lanes(u[j[1]]) - ui),
                          (lanes(x[j[2]]) - xi) * (lanes(u[j[2]]) - ui),
                          (lanes(x[j[3]]) - xi) * (lanes(u[j[3]]) - ui));
              for (unsigned int a = 0; a < n_sums; ++a)
                {
                  Lanes near, far;
                  load(near, sum_weight[a].near.data() + k);
                  load(far, sum_weight[a].far.data() + k);
                  own[a] += near * extension;
                  far *= extension;
                  double *sum = sums[a].data();
                  for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
                    sum[j[lane]] += far[lane];
                }
            }
          for (unsigned int a = 0; a < n_sums; ++a)
            sums[a][i] += sum_of_all(own[a]);
        }
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    std::array<double, n_sums>
    FamilyOperator<dim, n_sums, own_force_weights>::states(const LocalIndex                  i,
                                                           const std::array<double, n_sums> &s) const
    {
      if constexpr (n_sums == 1)
        return {{map[i][0] * s[0]}};
      else
        return {{map[i][0] * s[0] + map[i][1] * s[1], map[i][1] * s[0] + map[i][2] * s[1]}};
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::turn_sums_into_states() const
    {
      const bool has_ghosts = families->n_local() > families->n_owned();
      for (LocalIndex i = 0; i < families->n_owned(); ++i)
        {
          std::array<double, n_sums> s;
          for (unsigned int a = 0; a < n_sums; ++a)
            s[a] = sums[a][i];
          s = states(i, s);
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              state[a][i] = s[a];
              if (has_ghosts)
                ghosted_states.local_element(n_sums * i + a) = s[a];
            }
        }
      if (has_ghosts)
        {
          ghosted_states.update_ghost_values();
          for (LocalIndex i = families->n_owned(); i < families->n_local(); ++i)
            for (unsigned int a = 0; a < n_sums; ++a)
              state[a][i] = ghosted_states.local_element(n_sums * i + a);
          ghosted_states.zero_out_ghost_values();
        }
      // In 2-D both states ride in the record of the displacement, in 3-D the first.
      for (LocalIndex i = 0; i < families->n_local(); ++i)
        for (unsigned int a = 0; a < n_sums && dim + a < 4; ++a)
          displacements[i].value[dim + a] = state[a][i];
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::sum_forces() const
    {
      const LocalIndex *neighbour = bonds.neighbour.data();
      const NodeRecord *x = positions.data(), *u = displacements.data();
      NodeRecord       *f       = forces.data();
      const Weights    &weights = force_weights();
      std::fill(forces.begin(), forces.end(), NodeRecord{});

      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        {
          const Lanes xi = lanes(x[i]), ui = lanes(u[i]);
          Lanes       own = {};
          for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
            {
              const LocalIndex *j = neighbour + k;
              // x has zeros behind the coordinates, which keeps the states out of the sum.
              const Lanes bond[4] = {
                lanes(x[j[0]]) - xi, lanes(x[j[1]]) - xi, lanes(x[j[2]]) - xi, lanes(x[j[3]]) - xi};
              const Lanes uj[4] = {lanes(u[j[0]]), lanes(u[j[1]]), lanes(u[j[2]]), lanes(u[j[3]])};
              Lanes       extension, magnitude;
              sum_of_each(extension,
                          bond[0] * (uj[0] - ui),
                          bond[1] * (uj[1] - ui),
                          bond[2] * (uj[2] - ui),
                          bond[3] * (uj[3] - ui));
              load(magnitude, stiffness.data() + k);
              magnitude *= extension;
              for (unsigned int a = 0; a < n_sums; ++a)
                {
                  Lanes near, far;
                  load(near, weights[a].near.data() + k);
                  load(far, weights[a].far.data() + k);
                  const double *s         = state[a].data();
                  const Lanes   far_state = dim + a < 4 ? Lanes{uj[0][(dim + a) % 4],
                                                              uj[1][(dim + a) % 4],
                                                              uj[2][(dim + a) % 4],
                                                              uj[3][(dim + a) % 4]} :
                                                          Lanes{s[j[0]], s[j[1]], s[j[2]], s[j[3]]};
                  magnitude += near * s[i] + far * far_state;
                }
              for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
                {
                  const Lanes pull = magnitude[lane] * bond[lane];
                  own += pull;
                  lanes(f[j[lane]]) -= pull;
                }
            }
          lanes(f[i]) += own;
        }
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::vmult(NodalVector       &force,
                                                               const NodalVector &displacement) const
    {
      import_displacement(displacement);
      sum_over_families();
      turn_sums_into_states();
      sum_forces();
      // Bonds pull node i along +xi when stretched; K u resists with the opposite sign.
      for (LocalIndex i = 0; i < families->n_owned(); ++i)
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) = -forces[i].value[d];
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    std::vector<dealii::Tensor<2, dim>>
    FamilyOperator<dim, n_sums, own_force_weights>::diagonal_blocks() const
    {
      // K = sum_bonds stiffness xi xi^T + sum_i P_i map_i G_i with the rows
      // G_i = (d s/d u), P_i = (d F/d A). A node stands in its own G, P and in
      // those of its family.
      const LocalIndex                    n_owned = families->n_owned();
      std::vector<dealii::Tensor<2, dim>> result(n_owned);
      using Rows = std::array<dealii::Tensor<1, dim>, n_sums>;
      std::vector<Rows> own_sum(n_owned), own_force(n_owned);
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
          {
            const LocalIndex j = bonds.neighbour[k];
            if (j == i)
              continue;
            const auto                 xi = bond_vector(i, j);
            std::array<double, n_sums> near_sum, far_sum;
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                near_sum[a] = sum_weight[a].near[k];
                far_sum[a]  = sum_weight[a].far[k];
                own_sum[i][a] += near_sum[a] * xi;
                own_force[i][a] += force_weights()[a].near[k] * xi;
                if (j < n_owned)
                  {
                    own_sum[j][a] -= far_sum[a] * xi;
                    own_force[j][a] -= force_weights()[a].far[k] * xi;
                  }
              }
            // The neighbour's family moves with this node, and the other way round.
            double     of_i = stiffness[k], of_j = stiffness[k];
            const auto far_states = states(j, far_sum), near_states = states(i, near_sum);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                of_i += force_weights()[a].far[k] * far_states[a];
                of_j += force_weights()[a].near[k] * near_states[a];
              }
            const auto square = outer_product(xi, xi);
            result[i] += of_i * square;
            if (j < n_owned)
              result[j] += of_j * square;
          }
      for (LocalIndex i = 0; i < n_owned; ++i)
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            std::array<double, n_sums> unit = {};
            unit[a]                         = 1;
            const auto column               = states(i, unit);
            for (unsigned int b = 0; b < n_sums; ++b)
              result[i] += column[b] * outer_product(own_force[i][b], own_sum[i][a]);
          }
      return result;
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    void FamilyOperator<dim, n_sums, own_force_weights>::assemble(
      const typename BondOperator<dim>::AddBlock &add) const
    {
      BondCursor                   cursor(bonds);
      std::vector<BondCursor::End> ends;
      std::vector<GlobalIndex>     unknowns;
      std::vector<double>          values;
      for (LocalIndex i = 0; i < families->n_owned(); ++i)
        {
          cursor.find(i, families->begin(i), families->end(i), ends);
          const std::size_t n = dim * (ends.size() + 1);
          unknowns.resize(n);
          values.assign(n * n, 0.);
          // Rows G and P of this family over its unknowns, the node's own first.
          std::array<std::vector<double>, n_sums> sum_row, force_row;
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              sum_row[a].assign(n, 0.);
              force_row[a].assign(n, 0.);
            }
          for (int d = 0; d < dim; ++d)
            unknowns[d] = dim * families->global_number(i) + d;
          for (std::size_t m = 0; m < ends.size(); ++m)
            {
              const LocalIndex      j   = families->begin(i)[m];
              const BondCursor::End end = ends[m];
              const auto            xi  = bond_vector(i, j);
              const std::size_t     at  = dim * (m + 1);
              for (int d = 0; d < dim; ++d)
                unknowns[at + d] = dim * families->global_number(j) + d;
              for (unsigned int a = 0; a < n_sums; ++a)
                for (int d = 0; d < dim; ++d)
                  {
                    const auto  &s = sum_weight[a];
                    const auto  &p = force_weights()[a];
                    const double g = (end.is_near ? s.near : s.far)[end.slot] * xi[d];
                    const double f = (end.is_near ? p.near : p.far)[end.slot] * xi[d];
                    sum_row[a][at + d] += g;
                    sum_row[a][d] -= g;
                    force_row[a][at + d] += f;
                    force_row[a][d] -= f;
                  }
              // A bond's own stiffness is handed out once for each of its ends.
              for (int r = 0; r < dim; ++r)
                for (int c = 0; c < dim; ++c)
                  {
                    const double entry = stiffness[end.slot] * xi[r] * xi[c];
                    values[r * n + c] += entry;
                    values[r * n + at + c] -= entry;
                  }
            }
          for (unsigned int a = 0; a < n_sums; ++a)
            {
              std::array<double, n_sums> unit = {};
              unit[a]                         = 1;
              const auto column               = states(i, unit);
              for (unsigned int b = 0; b < n_sums; ++b)
                if (column[b] != 0)
                  for (std::size_t r = 0; r < n; ++r)
                    for (std::size_t c = 0; c < n; ++c)
                      values[r * n + c] += column[b] * force_row[b][r] * sum_row[a][c];
            }
          add(unknowns, values);
        }
    }

    template <int dim, unsigned int n_sums, bool own_force_weights>
    std::size_t FamilyOperator<dim, n_sums, own_force_weights>::memory_consumption() const
    {
      using dealii::MemoryConsumption::memory_consumption;
      std::size_t bytes = bonds.memory_consumption() + memory_consumption(stiffness) +
                          map.size() * sizeof(map[0]) + 3 * positions.size() * sizeof(NodeRecord) +
                          2 * n_sums * families->n_local() * sizeof(double);
      for (unsigned int a = 0; a < n_sums; ++a)
        bytes += memory_consumption(sum_weight[a].near) + memory_consumption(sum_weight[a].far) +
                 memory_consumption(force_weight[a].near) + memory_consumption(force_weight[a].far);
      return bytes;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const Families<dim>>                    &families,
                       LinearModel<dim>                                              &model,
                       const std::function<Moduli(const dealii::types::material_id)> &moduli)
  {
    const FamilyShape shape = model.shape();
    if (shape.n_sums == 1 && !shape.own_force_weights)
      return std::make_unique<FamilyOperator<dim, 1, false>>(families, model, moduli);
    if (shape.n_sums == 1)
      return std::make_unique<FamilyOperator<dim, 1, true>>(families, model, moduli);
    AssertThrow(shape.n_sums == 2 && !shape.own_force_weights, dealii::ExcNotImplemented());
    return std::make_unique<FamilyOperator<dim, 2, false>>(families, model, moduli);
  }

  template class BondOperator<2>;
  template class BondOperator<3>;
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const Families<2>> &,
                       LinearModel<2> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const Families<3>> &,
                       LinearModel<3> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
} // namespace perideal
