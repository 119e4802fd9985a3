// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_treatments_supports_h
#define perideal_treatments_supports_h

#include <perideal/base/rigid_body_motions.h>
#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/boundary/surface_nodes.h>
#include <perideal/operators/post/mirror_reactions.h>
#include <perideal/treatments/treated_body.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// A solution of the linear system.
  template <int dim>
  struct LinearEquilibrium
  {
    const ConstrainedOperator<dim> &system;
    const NodalVector              &displacement, &external_force;
    double                          time;
  };

  /// What supports do to a body in linear equilibrium.
  template <int dim>
  struct SupportBalance
  {
    /// Force on the body by condition [N].
    std::vector<dealii::Tensor<1, dim>> reactions;
    /// Energy of the bonds, and half the work of all forces on the body, those of supports included [J].
    double strain_energy, external_work;
  };

  /**
   * How prescribed displacements hold the body: one treatment of Boundary conditions/Displacement treatment.
   * A treatment says which nodes have unknowns, which of them it holds and where else values act, and what
   * the supports do to the body. This class is a body of which nothing is held; treatments fill in what they
   * need and override what they do in another way.
   */
  template <int dim>
  class Supports
  {
  public:
    /// Makes neither images nor held nodes.
    explicit Supports(const TreatedBody<dim> &body);
    virtual ~Supports() = default;

    /// Nodes whose displacements are unknowns, those of the cells first.
    virtual const NodeCloud<dim> &unknowns() const { return body.nodes; }

    /// These with fictitious nodes that move as they do; without such it is a copy of the unknowns.
    const std::shared_ptr<MirrorLayer<dim>> &images() const { return mirror; }

    /// Unknowns that take prescribed values.
    const DirichletNodes<dim> &held() const { return held_nodes; }

    /// Prescribed values in face gradients, where hold_nodes() is false; else none.
    /// Null until make_face_values().
    const std::shared_ptr<FaceValues<dim>> &face_values() const { return values; }
    void                                    make_face_values(const std::vector<BoundaryPoint<dim>> &points);
    /// Sets these to a time; along nonlinear equilibria the solver moves them.
    void set_face_values(const double time) const;

    /// Whether supports act on nodes, those of held(), and not on faces or images.
    virtual bool hold_nodes() const { return true; }

    /// Whether the surface itself has the prescribed displacements, and not the nodes beside it.
    virtual bool reach_surface() const { return true; }

    /// Nodes of faces among the unknowns; null where all belong to cells.
    virtual const SurfaceNodes<dim> *surface_nodes() const { return nullptr; }

    /// Whether set_reference() must come before set_displacements().
    virtual bool needs_reference() const { return false; }
    /// Takes the displacement of a reference solution at the nodes [m], that at t = 1.
    virtual void set_reference(const std::vector<dealii::Tensor<1, dim>> &) {}

    /// Writes what is prescribed at a time into held unknowns and images.
    virtual void set_displacements(const double time, NodalVector &displacement) const;

    /// Tells of each component that is held, at its node or its face.
    void hold(RigidBodyMotions<dim> &motions) const;

    /// Collective.
    virtual SupportBalance<dim> balance(const LinearEquilibrium<dim> &equilibrium) const;

    /// Forces on the body by condition [N], of those on nodes and those on the entries of face values, which
    /// solvers of nonlinear equilibria know. Collective.
    std::vector<dealii::Tensor<1, dim>> reactions(const NodalVector                         &on_nodes,
                                                  const std::vector<dealii::Tensor<1, dim>> &on_faces) const;

    /// The treatment with what it adds to the nodes, for the banner.
    virtual std::string describe() const;

  protected:
    /// Holds the nodes of as many layers of cells at held boundaries as the scene wants.
    void hold_layers();

    /// What supports that do not act on nodes do, after ConstrainedOperator::internal_force(). Collective.
    virtual MirrorReactions<dim> act_on_surface(const ConstrainedOperator<dim> &system) const;

    const TreatedBody<dim>            body;
    std::shared_ptr<MirrorLayer<dim>> mirror;
    DirichletNodes<dim>               held_nodes;
    std::shared_ptr<FaceValues<dim>>  values;
  };
} // namespace perideal

#endif
