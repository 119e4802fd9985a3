// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/comparison.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/errors.h>
#include <perideal/output/profiles.h>
#include <perideal/parameters/point_text.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Finite elements on the mesh itself, rigid-body motions removed.
    template <int dim, typename Fem>
    NodalField<dim> at_nodes(const SceneState<dim> &scene, const Fem &fem)
    {
      const auto                     &node_of_cell = scene.nodes->node_of_cell;
      std::vector<dealii::Point<dim>> point_of_cell(node_of_cell.size());
      for (std::size_t cell = 0; cell < point_of_cell.size(); ++cell)
        if (node_of_cell[cell] != dealii::numbers::invalid_unsigned_int)
          point_of_cell[cell] = scene.nodes->position[node_of_cell[cell]];
      const auto      values = fem.evaluate_in_cells(point_of_cell);
      NodalField<dim> result(scene.nodes->size());
      for (std::size_t cell = 0; cell < values.size(); ++cell)
        if (node_of_cell[cell] != dealii::numbers::invalid_unsigned_int)
          result[node_of_cell[cell]] = values[cell];
      scene.null_space.remove_mean(*scene.nodes, result);
      return result;
    }

    /// Finite elements on cells of their own, rigid-body motions removed.
    template <int dim>
    NodalField<dim> at_points(const SceneState<dim> &scene, const ElasticFem<dim> &fem)
    {
      auto result = fem.evaluate(scene.nodes->position);
      scene.null_space.remove_mean(*scene.nodes, result);
      return result;
    }
  } // namespace

  template <int dim>
  NodalField<dim> solve_fem(const SceneState<dim>       &scene,
                            const SolidsByMaterial<dim> &solids,
                            const double                 time,
                            const double                 tolerance,
                            const unsigned int           degree,
                            Timings                     &timings,
                            Json                        &report)
  {
    const Timings::Scope scope(timings, "fem");
    ElasticFem<dim>      fem(*scene.mesh, scene.loads, degree);
    {
      const Timings::Scope part(timings, "fem: assembly");
      fem.assemble(solids, time);
    }
    {
      const Timings::Scope part(timings, "fem: multigrid");
      fem.set_up_solver();
    }
    const Timings::Scope part(timings, "fem: solve");
    report["iterations"].push_back(fem.solve(tolerance));
    report["unknowns"] = fem.n_dofs();
    if (fem.is_on_mesh_itself())
      return at_nodes<dim>(scene, fem);
    return at_points<dim>(scene, fem);
  }

  template <int dim>
  NodalField<dim> nonlinear_fem_at_nodes(const SceneState<dim> &scene)
  {
    return at_nodes<dim>(scene, *scene.nonlinear_fem);
  }

  template <int dim>
  NodalField<dim> solve_reference(const SceneState<dim>       &scene,
                                  const Mesh<dim>             &mesh,
                                  const SolidsByMaterial<dim> &solids,
                                  const int                    refinements,
                                  const double                 time,
                                  Timings                     &timings)
  {
    const Timings::Scope scope(timings, "reference");
    ElasticFem<dim>      fem(mesh, scene.loads, 2, refinements);
    fem.assemble(solids, time);
    fem.set_up_solver();
    // Far below the discretisation errors that are to be seen.
    fem.solve(1e-10);
    return at_points<dim>(scene, fem);
  }

  template <int dim>
  NodalField<dim>
  evaluate_exact(const SceneState<dim> &scene, const ComparisonParameters &parameters, const double time)
  {
    NodalField<dim> result(scene.nodes->size());
    const char     *axes[] = {"x", "y", "z"};
    for (int d = 0; d < dim; ++d)
      {
        const SpaceTimeFunction<dim> function(parameters.exact[d],
                                              std::string("Comparison/Exact u_") + axes[d]);
        if (!function.is_present())
          throw InputError("the exact solution lacks a component")
            .parameter(std::string("Comparison/Exact u_") + axes[d])
            .allowed("a formula for every component, or none at all");
        for (LocalIndex i = 0; i < result.size(); ++i)
          result[i][d] = function.value(scene.nodes->position[i], time);
      }
    scene.null_space.remove_mean(*scene.nodes, result);
    return result;
  }

  namespace
  {
    template <int dim>
    using Profiles = std::vector<std::pair<std::string, std::unique_ptr<Profile<dim>>>>;

    template <int dim>
    Json errors_of(const SceneState<dim> &scene,
                   const NodalField<dim> &field,
                   const NodalField<dim> &reference,
                   const Profiles<dim>   &profiles)
    {
      const char *components[] = {"u_x", "u_y", "u_z"};
      const auto  errors       = field_errors(
        *scene.nodes, field, reference, [&](const LocalIndex i) { return scene.held.in_collar(i); });
      Json result = {{"l2", errors.l2}, {"max", errors.max}};
      for (const auto &profile : profiles)
        {
          const auto along = profile_errors(*scene.nodes, profile.second->local_nodes(), field, reference);
          for (int d = 0; d < dim; ++d)
            result["profiles"][profile.first][components[d]] = along[d];
        }
      return result;
    }
  } // namespace

  template <int dim>
  std::pair<dealii::Point<dim>, dealii::Point<dim>> ends_of(const LineText &line)
  {
    const std::string section = "Comparison/" + line.name;
    const std::pair   result{read_point<dim>(line.from, section + "/From"),
                           read_point<dim>(line.to, section + "/To")};
    if (result.first == result.second)
      throw InputError("the line has no length").parameter(section + "/To").given(line.to);
    return result;
  }

  template <int dim>
  void check_lines(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const std::vector<LineText> &lines)
  {
    for (const LineText &line : lines)
      {
        const auto [from, to] = ends_of<dim>(line);
        const auto   found    = LineProfile<dim>(mesh, nodes, from, to).local_nodes().size();
        const double all      = dealii::Utilities::MPI::sum(static_cast<double>(found), nodes.communicator);
        if (all == 0)
          throw InputError("the line passes through no cell of the body")
            .parameter("Comparison/" + line.name)
            .given(line.from + " to " + line.to);
      }
  }

  template <int dim>
  Json compare(const SceneState<dim>      &scene,
               const ComparisonParameters &parameters,
               const std::string          &output_directory)
  {
    Profiles<dim> profiles;
    for (const std::string &name : parameters.profiles)
      profiles.emplace_back(
        name,
        std::make_unique<BoundaryProfile<dim>>(
          *scene.mesh, *scene.nodes, scene.mesh->boundary_id(name, "Comparison/Profiles")));
    for (const LineText &line : parameters.lines)
      {
        const auto [from, to] = ends_of<dim>(line);
        profiles.emplace_back(line.name,
                              std::make_unique<LineProfile<dim>>(*scene.mesh, *scene.nodes, from, to));
      }

    Json result = Json::object();
    for (const auto &solution : scene.comparisons)
      result[solution.first] = errors_of(scene, scene.displacement, solution.second, profiles);
    // The finite elements' own error, beside which ours is to be read.
    if (scene.comparisons.count("fem") > 0)
      for (const char *truth : {"reference", "exact"})
        if (scene.comparisons.count(truth) > 0)
          result["fem"][std::string("own error against ") + truth] =
            errors_of(scene, scene.comparisons.at("fem"), scene.comparisons.at(truth), profiles);

    for (const auto &profile : profiles)
      {
        std::vector<typename Profile<dim>::NamedField> fields = {{"perideal", scene.displacement}};
        fields.insert(fields.end(), scene.comparisons.begin(), scene.comparisons.end());
        profile.second->write(output_directory + "/profile_" + profile.first + ".csv", fields);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(solve_fem)
  PERIDEAL_INSTANTIATE(nonlinear_fem_at_nodes)
  PERIDEAL_INSTANTIATE(solve_reference)
  PERIDEAL_INSTANTIATE(evaluate_exact)
  PERIDEAL_INSTANTIATE(ends_of)
  PERIDEAL_INSTANTIATE(check_lines)
  PERIDEAL_INSTANTIATE(compare)

} // namespace perideal
