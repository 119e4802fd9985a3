// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_loading_h
#define perideal_problem_loading_h

#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/boundary/face_values.h>
#include <perideal/boundary/mirror_layer.h>
#include <perideal/boundary/point_forces.h>
#include <perideal/boundary/published_transfer.h>
#include <perideal/boundary/surface_nodes.h>
#include <perideal/operators/linear/taylor_extension.h>
#include <perideal/operators/system/constrained_operator.h>
#include <perideal/operators/system/null_space.h>
#include <perideal/problem/discrete_body.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <vector>

namespace perideal
{
  class Timings;

  /// Forces of the supports and energies of a linear equilibrium.
  template <int dim>
  struct StaticBalance
  {
    /// By condition [N], held components only.
    std::vector<dealii::Tensor<1, dim>> reactions;
    /// Of all ranks [J].
    double strain_energy = 0, external_work = 0;
  };

  /**
   * The loads and supports of a scene, and how they reach the nodes: which nodes are unknowns, which of them
   * are held, what stands for bonds that are missing behind the surface, and the external forces at a time.
   */
  template <int dim>
  class Loading
  {
  public:
    /// The body must outlive this object.
    explicit Loading(const Body<dim> &body);

    /// Reads loads and conditions; needs the mesh.
    /// @throws InputError on wrong formulas or unknown boundaries.
    void read();

    /// Chooses unknowns and held nodes; needs the nodes. Collective.
    void choose_nodes();

    /// Finds the cells of point loads. Collective.
    void place_point_forces();

    /// Takes the values that conditions prescribe at faces; needs the gradient.
    void take_face_values(const FaceGradient<dim> &gradient);

    /// Adds what acts besides the bonds, and makes what passes tractions on. Collective.
    void surround(DiscreteBody<dim> &discretisation, Timings &timings);

    /// Returns the nodes whose displacements are the unknowns, those of the cells first.
    const NodeCloud<dim> &unknowns() const;

    /// Returns whether prescribed displacements hold nodes, and not images or faces.
    bool holds_nodes() const;

    /// Evaluates everything that is prescribed. Collective.
    /// @throws InputError naming what is not a finite number somewhere.
    void check_finite(const double time) const;

    /// Sets images and, where no solver moves them, values at faces to a time.
    void move_supports(const double time);

    /// Sets held components of a displacement to their values at a time.
    /// @param reference displacement at t = 1 that nodes are held at; null: the conditions' own
    void prescribe(const double                               time,
                   const std::vector<dealii::Tensor<1, dim>> *reference,
                   NodalVector                               &displacement) const;

    /// Sets the external force of all loads at a time [N], overwritten. Collective.
    void external_force(const DiscreteBody<dim> &discretisation, const double time, NodalVector &force) const;

    /// Tractions of faces, body forces and point loads of this rank as forces at their places, at t = 1.
    std::vector<typename NullSpace<dim>::Force> forces_on_body() const;

    /// Returns supports and energies of a linear equilibrium. Collective.
    StaticBalance<dim> balance(const DiscreteBody<dim>        &discretisation,
                               const ConstrainedOperator<dim> &system,
                               const NodalVector              &displacement,
                               const NodalVector              &external,
                               const double                    time) const;

    /// Returns the resultants of the loads and of what the nodes get of them, for summary.json. Collective.
    nlohmann::ordered_json resultants(const DiscreteBody<dim> &discretisation,
                                      const NodalVector       &displacement,
                                      const NodalVector       &external,
                                      const double             time) const;

    const Body<dim> &body;
    Loads<dim>       loads;
    /// Faces of all ranks, where tractions act in depth.
    std::vector<SurfaceFace<dim>>     surface;
    DirichletNodes<dim>               held;
    std::shared_ptr<FaceValues<dim>>  face_values;
    std::shared_ptr<MirrorLayer<dim>> images;
    PointForces<dim>                  point_forces;
    /// Where prescribed displacements have nodes of their own.
    std::unique_ptr<SurfaceNodes<dim>> surface_nodes;
    /// Where tractions act through transfer functions; the second is the same object, where as published.
    std::shared_ptr<const TractionTransfer<dim>>  transfer;
    std::shared_ptr<const PublishedTransfer<dim>> published_transfer;
    /// The operator of the bonds, where ghosts stand for those that are missing.
    std::shared_ptr<TaylorExtension<dim>> extension;

  private:
    /// Forces by the tractions and body forces of some loads on the conditions of the scene, overwritten.
    void set_tractions(const DiscreteBody<dim> &discretisation,
                       const Loads<dim>        &given,
                       const double             time,
                       NodalVector             &force) const;
    /// Resultant over the faces of a condition of the tractions that ghosts meet there.
    Resultant<dim>
    met_by_extension(const std::size_t condition, const NodalVector &displacement, const double time) const;
    StaticBalance<dim> balance_of_extension(const ConstrainedOperator<dim> &system,
                                            const NodalVector              &displacement,
                                            const NodalVector              &external,
                                            const double                    time) const;
  };
} // namespace perideal

#endif
