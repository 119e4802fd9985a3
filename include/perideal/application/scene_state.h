// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_scene_state_h
#define perideal_application_scene_state_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/boundary/gauges.h>
#include <perideal/boundary/mirror_layer.h>
#include <perideal/boundary/point_forces.h>
#include <perideal/boundary/published_transfer.h>
#include <perideal/boundary/surface_nodes.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/fem/hyperelastic_fem.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/fracture/no_fail_zones.h>
#include <perideal/mesh/mesh.h>
#include <perideal/neighbourhood/connected_parts.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/nodes/nodes.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/contact_force.h>
#include <perideal/operators/force/relative_damping.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/linear/taylor_extension.h>
#include <perideal/operators/post/areal_force_density.h>
#include <perideal/operators/system/constrained_operator.h>
#include <perideal/operators/system/null_space.h>
#include <perideal/operators/weights/correspondence_rows.h>
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/reconstruction/face_gradient.h>
#include <perideal/solvers/linear_solver.h>
#include <perideal/solvers/tangent_solver.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  /// A displacement at this rank's nodes [m].
  template <int dim>
  using NodalField = std::vector<dealii::Tensor<1, dim>>;

  /**
   * The parts of a scene as they come into being: each step of the simulation
   * adds its own and uses the earlier ones.
   */
  template <int dim>
  struct SceneState
  {
    std::unique_ptr<Mesh<dim>> mesh;
    Loads<dim>                 loads;
    SolidsByMaterial<dim>      solids;

    std::unique_ptr<Nodes<dim>>    nodes;
    std::vector<BoundaryFace<dim>> faces;
    /// Those of all ranks, where tractions act in depth.
    std::vector<SurfaceFace<dim>> surface;
    DirichletNodes<dim>           held;
    /// Where the scene needs gradients: the consistent form, strains and stresses do.
    std::shared_ptr<const FaceGradient<dim>> gradient;
    std::shared_ptr<FaceValues<dim>>         face_values;
    std::shared_ptr<MirrorLayer<dim>>        mirror;
    PointForces<dim>                         point_forces;
    /// Where prescribed displacements have nodes of their own.
    std::unique_ptr<SurfaceNodes<dim>> surface_nodes;
    /// Where tractions act through transfer functions; the second is the same object, where as printed.
    std::shared_ptr<const TractionTransfer<dim>>  transfer;
    std::shared_ptr<const PublishedTransfer<dim>> published_transfer;
    std::shared_ptr<Families<dim>>                families;
    /// What of the body hangs together.
    std::optional<ConnectedParts<dim>> parts;

    /// What the model made of the bonds; the consistent form has no such.
    std::unique_ptr<LinearModel<dim>>  model;
    std::shared_ptr<BondWeights<dim>>  weights;
    std::shared_ptr<BondOperator<dim>> bonds;
    /// What became of the families, of all ranks and by owned node.
    FamilyCounts              family_counts;
    std::vector<FamilyReport> family_reports;
    /// Of the correspondence model, in the place of weights.
    LawsByMaterial<dim>                      laws;
    std::shared_ptr<CorrespondenceRows<dim>> correspondence;
    /// C of whole families by their quadrature [Pa], where the scene needs it.
    std::optional<dealii::SymmetricTensor<4, dim>> family_stiffness;
    /// The same object as bonds, where ghosts stand for the bonds that are missing.
    std::shared_ptr<TaylorExtension<dim>>     ghosts;
    std::unique_ptr<ConstrainedOperator<dim>> system;
    NullSpace<dim>                            null_space;
    std::unique_ptr<ElasticFem<dim>>          auxiliary_fem;
    std::unique_ptr<LinearSolver<dim>>        linear_solver;
    /// Where Newton's method seeks equilibria.
    std::shared_ptr<TangentOperator<dim>>     tangent;
    std::unique_ptr<ConstrainedOperator<dim>> tangent_system;
    std::unique_ptr<TangentSolver<dim>>       tangent_solver;

    /// Where the scene asks for some.
    std::unique_ptr<ArealForceDensity<dim>> areal_forces;
    std::unique_ptr<Gauges<dim>>            gauges;
    /// Finite elements of finite strain beside which nonlinear equilibria lie.
    std::unique_ptr<HyperelasticFem<dim>> nonlinear_fem;

    // Dynamics have these, and nonlinear equilibria those of failure.
    std::array<SpaceTimeFunction<dim>, dim> initial_velocity;
    std::vector<Precrack<dim>>              precracks;
    std::unique_ptr<NoFailZones<dim>>       no_fail_zones;
    GlobalIndex                             n_no_fail_nodes = 0;
    std::unique_ptr<CrackTracker<dim>>      crack_tracker;
    std::unique_ptr<BondForce<dim>>         force;
    /// Where the scene has them.
    std::unique_ptr<ContactForce<dim>>    contact;
    std::unique_ptr<RelativeDamping<dim>> relative_damping;

    /// The nodes whose displacements are the unknowns, those of the cells first.
    const NodeCloud<dim> &unknowns() const
    {
      return surface_nodes ? surface_nodes->nodes() : static_cast<const NodeCloud<dim> &>(*nodes);
    }

    /// Displacement of the nodes after the last step, rigid-body motions removed; in dynamics their velocity.
    NodalField<dim> displacement, velocity;
    /// Solutions it is held against, by name: "fem", "reference", "exact".
    std::map<std::string, NodalField<dim>> comparisons;
  };
} // namespace perideal

#endif
