// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_discrete_body_h
#define perideal_problem_discrete_body_h

#include <perideal/materials/linear_model.h>
#include <perideal/neighbourhood/connected_parts.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/weights/consistent_bonds.h>
#include <perideal/operators/weights/correspondence_rows.h>
#include <perideal/operators/weights/family_weights.h>
#include <perideal/parameters/hyperelastic_law.h>
#include <perideal/problem/body.h>
#include <perideal/problem/cell_gradients.h>

#include <memory>
#include <optional>
#include <vector>

namespace perideal
{
  template <int dim>
  class BondForce;
  template <int dim>
  struct CellExpansion;
  template <int dim>
  class FaceValues;
  template <int dim>
  class GaussPoints;

  /**
   * What the model and its quadrature make of the body: families, weights and the linear operator of the
   * bonds. One of four kinds: weighed bonds between nodes, bonds between Gauss points, the consistent form
   * with strains from faces, and the correspondence model.
   */
  template <int dim>
  struct DiscreteBody
  {
    /// Finds the families of a cloud of nodes, those of the body first. Collective.
    /// @throws InputError when a node has no neighbour.
    void find_families(const SceneParameters &parameters, const NodeCloud<dim> &cloud);

    /// Finds what of the body hangs together, unless that is known. Collective.
    /// @param is_cut bonds that precracks cut; empty: none
    void find_parts(const Body<dim> &body, const BondPredicate<dim> &is_cut);

    /// Weighs the families and makes the operator. Collective.
    /// @param face_values prescribed at faces, of models that read them
    void weigh(const Body<dim>                        &body,
               const std::shared_ptr<FaceValues<dim>> &face_values,
               const BondPredicate<dim>               &is_cut);

    /// Hands the free expansion of the cells to the linear operator, and to the force.
    void expand(const Body<dim> &body, const std::shared_ptr<const CellExpansion<dim>> &of_cells);
    void expand(const Body<dim>                                 &body,
                const std::shared_ptr<const CellExpansion<dim>> &of_cells,
                BondForce<dim>                                  &force) const;

    /// Measures the stiffness of whole families, where finite elements are to have it. Collective.
    /// @throws InputError where no family is whole, or several materials have several stiffnesses.
    void measure_families(const Body<dim> &body);

    /// Returns the solids of finite elements on a mesh of the body that the solution is compared with: of the
    /// material, or as stiff as whole families.
    SolidsByMaterial<dim> compared_solids(const Body<dim> &body, const Mesh<dim> &mesh) const;

    /// Makes the nonlinear force of the bonds, none of them broken. Body and this must outlive it.
    /// Collective.
    std::unique_ptr<BondForce<dim>> create_force(const Body<dim> &body) const;

    /// Returns the families with what bonds they would have; of bodies where whole ones are made on demand
    /// those of some nodes. Collective.
    std::shared_ptr<const Families<dim>> sample_of_whole_families() const;

    /// Makes the tangent of that force.
    std::shared_ptr<TangentOperator<dim>> create_tangent() const;

    std::shared_ptr<Families<dim>>     families;
    std::optional<ConnectedParts<dim>> parts;
    /// Where the scene needs gradients: the consistent form, strains and stresses do.
    CellGradients<dim> gradients;

    /// What the model made of the bonds. The consistent form has a model only of bonds that may break, and
    /// weighs them where they are made.
    std::unique_ptr<LinearModel<dim>>  model;
    std::shared_ptr<BondWeights<dim>>  weights;
    std::shared_ptr<BondOperator<dim>> bonds;
    /// What became of the families, of all ranks and by owned node.
    FamilyCounts              counts;
    std::vector<FamilyReport> reports;
    /// Of the correspondence model and the consistent form.
    LawsByMaterial<dim> laws;
    /// What families without weights have in their place: of the consistent form, of correspondence.
    std::shared_ptr<ConsistentBonds<dim>>    consistent_bonds;
    std::shared_ptr<CorrespondenceRows<dim>> correspondence;
    /// C of whole families by their quadrature [Pa], where the scene needs it.
    std::optional<dealii::SymmetricTensor<4, dim>> family_stiffness;

  private:
    void weigh_nodes(const Body<dim> &body, const BondPredicate<dim> &is_cut);
    void weigh_gauss_points(const Body<dim> &body);
    void weigh_faces(const Body<dim>                        &body,
                     const std::shared_ptr<FaceValues<dim>> &face_values,
                     const BondPredicate<dim>               &is_cut);
    void weigh_correspondence(const Body<dim> &body);
    /// Points of this rank where faces have prescribed values, and the spacing of their nodes.
    std::vector<std::pair<dealii::Point<dim>, double>> held_faces() const;
  };

  /// Returns the solids as the model of the scene takes them: bond-based ones have a Poisson's ratio of
  /// their own.
  template <int dim>
  SolidOf<dim> solids_of_model(const Body<dim> &body);
} // namespace perideal

#endif
