// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/areal_forces.h>
#include <perideal/application/comparison.h>
#include <perideal/application/output_fields.h>
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/operators/linear/surface_cure.h>
#include <perideal/solvers/preconditioner_choice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

// Simulation: the parts of a scene come into being, up to the solver.

namespace perideal
{
  namespace
  {
    template <int dim>
    const MaterialProperties &properties_on(const Mesh<dim>                 &mesh,
                                            const MaterialParameters        &materials,
                                            const dealii::types::material_id id)
    {
      for (const auto &group : materials.groups)
        if (mesh.material_id(group.first, "Material/" + group.first) == id)
          return group.second;
      return materials.body;
    }
  } // namespace

  template <int dim>
  const MaterialProperties &Simulation<dim>::properties_of(const dealii::types::material_id id) const
  {
    return properties_on(*scene.mesh, parameters.material, id);
  }

  template <int dim>
  SolidsByMaterial<dim> Simulation<dim>::solids_on(const Mesh<dim> &mesh) const
  {
    SolidsByMaterial<dim> result;
    for (const auto id : mesh.material_ids)
      result[id] =
        parameters.material.template elastic_solid<dim>(properties_on(mesh, parameters.material, id));
    return result;
  }

  template <int dim>
  SolidsByMaterial<dim> Simulation<dim>::compared_solids_on(const Mesh<dim> &mesh) const
  {
    if (!parameters.comparison.by_families())
      return solids_on(mesh);
    SolidsByMaterial<dim> result;
    for (const auto id : mesh.material_ids)
      result[id] = elastic_solid<dim>(*scene.family_stiffness);
    return result;
  }

  template <int dim>
  bool Simulation<dim>::by_nodes() const
  {
    return parameters.loads.holds_layer() || parameters.loads.has_surface_nodes();
  }

  template <int dim>
  void Simulation<dim>::make_mesh()
  {
    const Timings::Scope scope(timings, "mesh");
    scene.mesh  = create_mesh<dim>(parameters.mesh, communicator, context.scene_directory);
    scene.loads = resolve_boundaries(*scene.mesh, Loads<dim>(parameters.loads));
    for (const std::string &name : parameters.comparison.profiles)
      scene.mesh->boundary_id(name, "Comparison/Profiles");
    for (const std::string &name : parameters.boundary_stress)
      scene.mesh->boundary_id(name, "Output/Boundary stress");
    for (const auto &group : parameters.material.groups)
      scene.mesh->material_id(group.first, "Material/" + group.first);
    scene.solids = solids_on(*scene.mesh);
  }

  template <int dim>
  void Simulation<dim>::make_nodes_and_families()
  {
    const Timings::Scope scope(timings, "neighbours");
    scene.nodes = std::make_unique<Nodes<dim>>(*scene.mesh, parameters.nodes);
    prepare_cells(parameters.quadrature, *scene.mesh, *scene.nodes);
    scene.faces = find_boundary_faces(*scene.mesh, *scene.nodes);
    if (parameters.loads.act_in_depth() ||
        parameters.model.boundary_compensation == BoundaryCompensation::closed_form)
      scene.surface = gather_faces(scene.faces, communicator);
    if (parameters.loads.has_mirror())
      {
        scene.mirror =
          std::make_shared<MirrorLayer<dim>>(*scene.mesh, *scene.nodes, scene.faces, scene.loads);
        scene.held = DirichletNodes<dim>({}, scene.loads, scene.nodes->size());
      }
    else if (parameters.loads.has_surface_nodes())
      {
        scene.surface_nodes = std::make_unique<SurfaceNodes<dim>>(*scene.nodes, scene.faces, scene.loads);
        scene.mirror        = std::make_shared<MirrorLayer<dim>>(scene.unknowns());
        scene.held = DirichletNodes<dim>(scene.surface_nodes->faces(), scene.loads, scene.unknowns().size());
      }
    else
      {
        const bool at_faces = parameters.loads.displacement_treatment == DisplacementTreatment::face_value ||
                              parameters.loads.displacement_treatment == DisplacementTreatment::taylor_ghosts;
        scene.mirror = std::make_shared<MirrorLayer<dim>>(*scene.nodes);
        scene.held   = parameters.loads.layers > 1 ?
                         DirichletNodes<dim>(
                         *scene.mesh, *scene.nodes, scene.faces, scene.loads, parameters.loads.layers) :
                         DirichletNodes<dim>(at_faces ? std::vector<BoundaryFace<dim>>() : scene.faces,
                                           scene.loads,
                                           scene.nodes->size());
      }
    check_lines(*scene.mesh, *scene.nodes, parameters.comparison.lines);
    scene.families =
      std::make_shared<Families<dim>>(scene.mirror->nodes(), create_volume_rule<dim>(parameters.quadrature));
    if (scene.families->statistics().min == 0)
      throw InputError("a node has no neighbour within its horizon")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor, or give the body more than one cell");
    if (!scene.loads.point_loads.empty())
      scene.point_forces =
        PointForces<dim>(*scene.mesh, CellGraph<dim>(*scene.mesh, *scene.nodes), scene.loads);
    if (!parameters.gauges.gauges.empty())
      scene.gauges = std::make_unique<Gauges<dim>>(
        *scene.mesh, CellGraph<dim>(*scene.mesh, *scene.nodes), read_gauges<dim>(parameters.gauges));
  }

  template <int dim>
  void Simulation<dim>::make_gradient()
  {
    const Timings::Scope part(timings, "setup: face gradient");
    scene.gradient = std::make_shared<const FaceGradient<dim>>(
      *scene.mesh, *scene.nodes, [&](const dealii::types::material_id id) {
        return scene.solids.at(id).isotropic().shear_modulus();
      });
    scene.face_values = by_nodes() ? std::make_shared<FaceValues<dim>>() :
                                     std::make_shared<FaceValues<dim>>(*scene.gradient, scene.loads);
  }

  template <int dim>
  SolidOf<dim> Simulation<dim>::solid_of_model() const
  {
    return [this](const dealii::types::material_id id) {
      const ElasticSolid<dim> &solid = scene.solids.at(id);
      return parameters.model.takes_any_symmetry() ?
               solid :
               ElasticSolid<dim>(parameters.model.constants_of_model(solid.isotropic()));
    };
  }

  template <int dim>
  void Simulation<dim>::weigh_bonds()
  {
    const Timings::Scope scope(timings, "setup");
    find_parts();
    const auto solid_of = solid_of_model();
    if (parameters.model.is_linear_only() || parameters.model.is_consistent() ||
        (needs_gradient(parameters.field_names()) &&
         !(parameters.model.is_correspondence() && parameters.solver.is_nonlinear_static())))
      make_gradient();
    if (parameters.model.is_correspondence())
      make_correspondence();
    else if (parameters.model.is_consistent())
      {
        const Timings::Scope part(timings, "setup: weights");
        scene.bonds = std::make_shared<ConsistentOperator<dim>>(
          scene.families,
          scene.gradient,
          scene.face_values,
          create_consistent<dim>(parameters.model, parameters.nodes.horizon_factor),
          solid_of);
      }
    else if (parameters.quadrature.has_gauss_points())
      weigh_gauss_points();
    else
      {
        const Timings::Scope part(timings, "setup: weights");
        scene.model = create_model<dim>(parameters.model, scene.mesh->thickness, compensation_factors());
        scene.weights =
          perideal::weigh_bonds<dim>(scene.families,
                                     *scene.model,
                                     solid_of,
                                     {parameters.model.after_the_cut() ? precrack_test() : nullptr,
                                      parameters.model.recomputes(),
                                      parameters.nodes.share_equal_families});
        scene.bonds = create_bond_operator<dim>(scene.weights);
        if (parameters.model.has_surface_cure())
          scene.bonds =
            std::make_shared<SurfaceCure<dim>>(scene.bonds, scene.gradient, scene.nodes->volume, solid_of);
      }
    if (parameters.loads.has_taylor_extension())
      add_taylor_extension();
    if (parameters.loads.has_transfer())
      make_transfer();
    measure_families();
    scene.family_counts  = scene.bonds->counts;
    scene.family_reports = scene.bonds->reports;
    scene.system         = std::make_unique<ConstrainedOperator<dim>>(
      scene.bonds, scene.mirror, scene.unknowns(), scene.held.mask());
    scene.areal_forces = create_areal_forces(scene, parameters, solid_of);
  }

  template <int dim>
  void Simulation<dim>::find_free_motions()
  {
    find_parts();
    if (scene.parts->n_bodies > 1)
      {
        check_bodies_held();
        return;
      }
    // Which motions the held components allow: those of nodes, or of faces where images or face values hold.
    const auto         box = dealii::GridTools::compute_bounding_box(scene.mesh->triangulation);
    dealii::Point<dim> lower, upper;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] = dealii::Utilities::MPI::min(box.lower_bound(d), communicator);
        upper[d] = dealii::Utilities::MPI::max(box.upper_bound(d), communicator);
      }
    RigidBodyMotions<dim>     motions(lower + 0.5 * (upper - lower), lower.distance(upper));
    const DirichletNodes<dim> on_faces =
      !by_nodes() ? DirichletNodes<dim>(scene.faces, scene.loads, scene.nodes->size()) : scene.held;
    for (const auto &entry : on_faces.entries())
      motions.hold(!by_nodes() ? entry.point : scene.unknowns().position[entry.node], entry.component);

    const auto free = motions.free_motions(communicator);
    if (free.empty())
      return;
    if (parameters.loads.rigid_body_motions == FreeMotions::error)
      throw InputError("the conditions leave a rigid-body motion free: " +
                       RigidBodyMotions<dim>::describe(free))
        .parameter("Boundary conditions")
        .hint("hold these motions, or, where the loads balance, set Boundary conditions/Rigid body "
              "motions = remove");
    NodalVector      layout;
    const auto      &nodes = scene.unknowns();
    dealii::IndexSet owned(dim * nodes.n_global);
    owned.add_range(dim * nodes.first_global, dim * (nodes.first_global + nodes.size()));
    layout.reinit(owned, communicator);
    scene.null_space = NullSpace<dim>(nodes, motions, free, layout);
  }

  template <int dim>
  void Simulation<dim>::prepare_comparisons()
  {
    if (parameters.comparison.reference ||
        parameters.loads.displacement_treatment == DisplacementTreatment::reference)
      {
        const std::string &file = parameters.comparison.reference_mesh;
        screen << "reference   Q2 finite elements, " << parameters.comparison.reference_refinements
               << " refinement(s)" << (file.empty() ? "" : " of " + file) << std::endl;
        std::unique_ptr<Mesh<dim>> own_mesh;
        if (!file.empty())
          {
            MeshParameters mesh = parameters.mesh;
            mesh.file           = file;
            mesh.generator.clear();
            mesh.distortion  = 0.;
            mesh.refinements = mesh.refine_times = 0;
            own_mesh = create_mesh<dim>(mesh, communicator, context.scene_directory);
          }
        const Mesh<dim> &mesh          = own_mesh ? *own_mesh : *scene.mesh;
        scene.comparisons["reference"] = solve_reference(
          scene, mesh, compared_solids_on(mesh), parameters.comparison.reference_refinements, 1., timings);
      }
  }

  template <int dim>
  PreconditionerChoice Simulation<dim>::prepare_preconditioner(const unsigned int n_solves)
  {
    SolverParameters solves = parameters.solver;
    solves.load_steps       = n_solves;
    const auto choice       = choose_preconditioner(solves,
                                              measure_solve(*scene.mesh,
                                                            *scene.nodes,
                                                            *scene.system,
                                                            scene.families->n_bonds(),
                                                            parameters.model.is_consistent()));
    if (choice.preconditioner == PreconditionerName::auxiliary)
      {
        if (choice.auxiliary_mesh == AuxiliaryMesh::parent)
          scene.auxiliary_fem =
            std::make_unique<ElasticFem<dim>>(*scene.mesh, scene.loads, create_parent_mesh(*scene.mesh));
        else
          scene.auxiliary_fem = std::make_unique<ElasticFem<dim>>(*scene.mesh, scene.loads);
        scene.auxiliary_fem->assemble(scene.solids, 0.);
      }
    summary["solver"]["preconditioner"] = name_of(choice.preconditioner);
    summary["solver"]["auxiliary_mesh"] =
      choice.auxiliary_mesh ? name_of(*choice.auxiliary_mesh) : std::string();
    return choice;
  }

  template <int dim>
  void Simulation<dim>::set_up_solver()
  {
    const Timings::Scope scope(timings, "setup");
    const Timings::Scope part(timings, "setup: preconditioner");
    const auto           choice = prepare_preconditioner(parameters.solver.load_steps);
    scene.linear_solver         = create_linear_solver(parameters.solver,
                                               choice,
                                               *scene.system,
                                               scene.null_space,
                                               *scene.nodes,
                                               scene.auxiliary_fem.get(),
                                               scene.surface_nodes.get());
    summary["solver"]["name"]   = scene.linear_solver->name();
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
