// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Tells at the end whether the model was used within its range: laws that leave a plane body no
    /// thickness, bonds with tensors that have turned further than they know, linear statics of large strain.
    template <int dim>
    class ValidityRecorder : public Recorder<dim>
    {
    public:
      ValidityRecorder(const Problem<dim> &problem, const bool is_linear)
        : problem(problem)
        , is_linear(is_linear)
      {
      }

      void finish(Json &summary) override
      {
        if (is_linear)
          {
            if (problem.state.displacement.size() == problem.body.nodes->size())
              find_largest_strain();
            return;
          }
        if (const auto *force = dynamic_cast<const ContinuumForce<dim> *>(problem.force.get());
            force != nullptr && dim == 2)
          {
            n_without_thickness                = count_without_thickness(*force);
            summary["nodes_without_thickness"] = n_without_thickness;
          }
        if (problem.parameters.model.is_tensor_involved())
          largest_motion = find_largest_motion();
      }

      std::string describe(const Json &, const bool) const override
      {
        std::string text;
        if (n_without_thickness > 0)
          text += "warning     at " + grouped(n_without_thickness) +
                  " nodes the law leaves the body no thickness: it is used beyond its range\n";
        // Taken for small, a rotation by w stretches by w^2/2: 0.5 % here.
        if (largest_motion > 0.1)
          text += "warning     the ends of bonds have moved against each other by up to " +
                  short_number(largest_motion) +
                  " times their length: bonds with tensors know small rotations only\n";
        if (linear.strain > 0.02)
          text += "warning     strains reach " + short_number(100. * linear.strain) +
                  " %: linear statics holds for small " +
                  "ones, to some per cent; check loads and units, or take Solver/Name = quasi static\n";
        // Taken for small, a rotation by w stretches by w^2/2.
        else if (linear.rotation > 0.2)
          text += "warning     parts of the body turn by up to " + short_number(linear.rotation) +
                  " rad: linear statics holds for small rotations, to some tenths; take Solver/Name = quasi "
                  "static\n";
        return text;
      }

    private:
      /// Collective.
      GlobalIndex count_without_thickness(const ContinuumForce<dim> &force) const
      {
        GlobalIndex number = 0;
        LocalIndex  i      = 0;
        for (const auto &H : force.gradients())
          number += force.law(i++).thickness_stretch(H) > 0 ? 0 : 1;
        return dealii::Utilities::MPI::sum(number, problem.run.communicator);
      }

      /// Of the ends of whole bonds against each other, over their length [-]. Collective.
      double find_largest_motion() const
      {
        const BondForce<dim> &force = *problem.force;
        const BondList       &bonds = force.bond_list();
        std::vector<bool>     is_lost(bonds.n_slots(), false);
        for (const auto &bond : force.lost_bonds())
          is_lost[bond.slot] = true;
        const NodeRecord *y       = force.positions();
        const auto       &x       = problem.discretisation.families->position;
        double            largest = 0;
        for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
          for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
            if (const LocalIndex j = bonds.neighbour[slot]; j != i && !is_lost[slot])
              {
                dealii::Tensor<1, dim> moved;
                for (int d = 0; d < dim; ++d)
                  moved[d] = (y[j].value[d] - y[i].value[d]) - (x[j][d] - x[i][d]);
                largest = std::max(largest, moved.norm() / x[i].distance(x[j]));
              }
        return dealii::Utilities::MPI::max(largest, problem.run.communicator);
      }

      /// From cells that share a face: how their nodes move along and across their line, over its length [-].
      /// Collective.
      void find_largest_strain()
      {
        const Nodes<dim> &nodes = *problem.body.nodes;
        const auto       &u     = problem.state.displacement;
        Linear            found;
        for (const auto &cell : problem.body.mesh->triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int f : cell->face_indices())
              if (!cell->at_boundary(f) && cell->neighbor(f)->is_active() &&
                  cell->neighbor(f)->is_locally_owned())
                {
                  const LocalIndex i      = nodes.node_of_cell[cell->active_cell_index()];
                  const LocalIndex j      = nodes.node_of_cell[cell->neighbor(f)->active_cell_index()];
                  const auto       line   = nodes.position[j] - nodes.position[i];
                  const auto       moved  = u[j] - u[i];
                  const double     along  = moved * line / line.norm_square();
                  const double     across = (moved - along * line).norm() / line.norm();
                  found.strain            = std::max(found.strain, std::abs(along));
                  found.rotation          = std::max(found.rotation, across);
                }
        linear.strain   = dealii::Utilities::MPI::max(found.strain, problem.run.communicator);
        linear.rotation = dealii::Utilities::MPI::max(found.rotation, problem.run.communicator);
      }

      /// The largest ones of a linear equilibrium.
      struct Linear
      {
        double strain = 0, rotation = 0;
      };

      const Problem<dim> &problem;
      const bool          is_linear;
      Linear              linear;
      GlobalIndex         n_without_thickness = 0;
      double              largest_motion      = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_validity_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    return std::make_unique<ValidityRecorder<dim>>(problem, !kind.has_motion && !kind.has_iterations);
  }

  PERIDEAL_INSTANTIATE(make_validity_recorder)
} // namespace perideal
