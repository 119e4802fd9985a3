// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/output/summary.h>
#include <perideal/problem/description.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// C by pairs of indices, ordered as in dealii::SymmetricTensor.
    template <int dim>
    double
    entry_of(const dealii::SymmetricTensor<4, dim> &stiffness, const unsigned int p, const unsigned int q)
    {
      using Pair   = dealii::SymmetricTensor<2, dim>;
      const auto a = Pair::unrolled_to_component_indices(p), b = Pair::unrolled_to_component_indices(q);
      return stiffness[a[0]][a[1]][b[0]][b[1]];
    }

    template <int dim>
    std::string describe_stiffness(const dealii::SymmetricTensor<4, dim> &stiffness)
    {
      return "C_xxxx " + short_number(entry_of<dim>(stiffness, 0, 0)) + ", C_xxyy " +
             short_number(entry_of<dim>(stiffness, 0, 1)) + ", C_xyxy " +
             short_number(entry_of<dim>(stiffness, dim, dim)) + " Pa";
    }
  } // namespace

  template <int dim>
  Json describe_discretisation(const Problem<dim> &problem)
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    using dealii::Utilities::MPI::sum;
    const MPI_Comm communicator = problem.run.communicator;
    double         smallest = 1e300, largest = 0, volume = 0;
    for (LocalIndex i = 0; i < problem.body.nodes->size(); ++i)
      {
        smallest = std::min(smallest, problem.body.nodes->spacing[i]);
        largest  = std::max(largest, problem.body.nodes->spacing[i]);
        volume += problem.body.nodes->volume[i];
      }
    const auto statistics = problem.discretisation.families->statistics();
    Json       result;
    result["mesh"]       = {{"dim", dim},
                            {"cells", problem.body.mesh->triangulation.n_global_active_cells()},
                            {"min_size", min(smallest, communicator)},
                            {"max_size", max(largest, communicator)},
                            {"volume", sum(volume, communicator)}};
    result["nodes"]      = problem.body.nodes->n_global;
    result["bonds"]      = problem.discretisation.families->n_bonds();
    result["neighbours"] = {{"min", statistics.min}, {"mean", statistics.mean}, {"max", statistics.max}};
    result["quadrature"] = name_of(problem.parameters.quadrature.scheme);
    result["model"]      = problem.parameters.model.model->name;
    result["variant"]  = problem.parameters.model.has_forms() ? problem.parameters.model.form : "uncorrected";
    result["families"] = {{"fallback", problem.discretisation.counts.fallback},
                          {"singular", problem.discretisation.counts.singular},
                          {"indefinite", problem.discretisation.counts.indefinite}};
    if (problem.discretisation.counts.different > 0)
      result["families"]["different"] = problem.discretisation.counts.different;
    if (const auto *zoned = dynamic_cast<const ZonedForce<dim> *>(problem.force.get()))
      {
        const auto whole            = zoned->whole_families();
        result["families"]["whole"] = {
          {"nodes", whole.nodes}, {"bytes", whole.bytes}, {"seconds", whole.seconds}};
      }
    if (problem.discretisation.family_stiffness)
      {
        Json rows;
        for (unsigned int p = 0; p < dim * (dim + 1) / 2; ++p)
          {
            Json row;
            for (unsigned int q = 0; q < dim * (dim + 1) / 2; ++q)
              row.push_back(entry_of(*problem.discretisation.family_stiffness, p, q));
            rows.push_back(row);
          }
        result["families"]["stiffness"] = rows;
      }
    return result;
  }

  template <int dim>
  Json list_skipped(const Problem<dim> &problem)
  {
    Json                     result;
    const SceneParameters   &parameters     = problem.parameters;
    const DiscreteBody<dim> &discretisation = problem.discretisation;
    const auto               bonds          = discretisation.families->n_bonds();
    if (!can_break(parameters))
      result["bond state (nothing can break)"] = bonds;
    const GlobalIndex different = discretisation.counts.different;
    const GlobalIndex families  = problem.loading.supports->images()->nodes().n_global;
    if (different > 0 && different < families)
      result["weights of families equal to others"] = families - different;
    if (const auto *zoned = dynamic_cast<const ZonedForce<dim> *>(problem.force.get()))
      result["whole families of nodes far from cracks"] =
        problem.body.nodes->n_global - zoned->whole_families().nodes;
    if (dealii::Utilities::MPI::n_mpi_processes(problem.run.communicator) == 1)
      result["halo exchange (one rank)"] = 1;
    if (families == problem.body.nodes->n_global)
      result["fictitious nodes (no mirror)"] = 1;
    const auto &shape = parameters.model.form_traits().shape;
    if (shape && shape->n_sums == 0)
      result["sums over families, their halo exchange"] = bonds;
    else if (shape && shape->n_sums == 1)
      result["second sum over families"] = bonds;
    return result;
  }

  template <int dim>
  std::string banner(const Problem<dim> &problem, const std::string &of_driver, const Json &skipped)
  {
    const SceneParameters   &parameters     = problem.parameters;
    const DiscreteBody<dim> &discretisation = problem.discretisation;
    const Loading<dim>      &loading        = problem.loading;
    const auto               statistics     = discretisation.families->statistics();
    const GlobalIndex        n_nodes        = problem.body.nodes->n_global;
    std::ostringstream       out;
    out << "mesh        " << problem.body.mesh->description << '\n'
        << "body        " << problem.body.box_in_words() << '\n'
        << "nodes       " << grouped(n_nodes) << ", horizon " << parameters.nodes.horizon_factor
        << " spacings, influence " << parameters.model.influence_function << '\n'
        << "bonds       " << grouped(discretisation.families->n_bonds()) << ", neighbours a node "
        << statistics.min << " / " << std::setprecision(4) << statistics.mean << " / " << statistics.max
        << " (min/mean/max)"
        << (parameters.quadrature.counts_parts() ? ", volumes by " + name_of(parameters.quadrature.scheme) :
                                                   "")
        << '\n'
        << "model       " << parameters.model.model->name
        << (parameters.model.has_forms() ? ", " + parameters.model.form + " form" : "") << ", "
        << (dim == 3 ? std::string("3-D") : name_of(parameters.material.assumption)) << '\n';
    const FamilyCounts &counts = discretisation.counts;
    out << "families    " << grouped(counts.fallback) << " with fallback weights, "
        << grouped(counts.singular) << " miss a moment condition (singular), " << grouped(counts.indefinite)
        << " had negative deviatoric weights\n";
    if (discretisation.family_stiffness)
      out << "stiffness   " << describe_stiffness<dim>(*discretisation.family_stiffness)
          << " by whole families\n";
    out << "boundaries  displacement by " << loading.supports->describe() << loading.tractions->describe();
    if (!problem.free_motions.empty())
      out << ", free rigid-body motions removed";
    out << '\n';
    if (problem.failure.no_fail_zones)
      out << "no failure  at the bonds of " << grouped(problem.failure.n_no_fail_nodes) << " nodes\n";
    out << of_driver << "not needed ";
    const char *separator = " ";
    for (const auto &item : skipped.items())
      {
        out << separator << item.key();
        separator = "; ";
      }
    out << '\n';
    return out.str();
  }

  PERIDEAL_INSTANTIATE(describe_discretisation)
  PERIDEAL_INSTANTIATE(list_skipped)
  PERIDEAL_INSTANTIATE(banner)
} // namespace perideal
