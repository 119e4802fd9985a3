// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/materials/models.h>
#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/force/correspondence_force.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/linear/correspondence_tangent.h>
#include <perideal/operators/linear/polynomial_response.h>
#include <perideal/operators/linear/zoned_tangent.h>
#include <perideal/problem/discrete_body.h>
#include <perideal/quadrature/bond_volume.h>

namespace perideal
{
  template <int dim>
  SolidOf<dim> solids_of_model(const Body<dim> &body)
  {
    return [&body](const dealii::types::material_id id) {
      const ElasticSolid<dim> &solid = body.solids.at(id);
      const ModelParameters   &model = body.parameters.model;
      return model.takes_any_symmetry() ? solid :
                                          ElasticSolid<dim>(model.constants_of_model(solid.isotropic()));
    };
  }

  namespace
  {
    /// The law of a scene: what is not one of laws is linear at rest, and may turn as it moves or along load
    /// steps.
    LawChoice law_of(const SceneParameters &parameters)
    {
      return parameters.model.is_correspondence() || parameters.solver.is_linear_static() ?
               parameters.model.law :
               LawChoice("Saint Venant-Kirchhoff");
    }
  } // namespace

  template <int dim>
  void DiscreteBody<dim>::find_families(const SceneParameters &parameters, const NodeCloud<dim> &cloud)
  {
    // Beside the consistent form whole families are made of what may break, and the others hold what
    // stabilises cells.
    const double listed =
      has_fracture_zone(parameters) ?
        std::min(1., consistent_form().defaults.horizon_factor / parameters.nodes.horizon_factor) :
        1.;
    families = std::make_shared<Families<dim>>(cloud, create_volume_rule<dim>(parameters.quadrature), listed);
    if (families->statistics().min == 0)
      throw InputError("a node has no neighbour within its horizon")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor, or give the body more than one cell");
  }

  template <int dim>
  void DiscreteBody<dim>::find_parts(const Body<dim> &body, const BondPredicate<dim> &is_cut)
  {
    if (!parts)
      parts.emplace(*body.mesh, *body.nodes, *families, is_cut);
  }

  template <int dim>
  void DiscreteBody<dim>::weigh(const Body<dim>                        &body,
                                const std::shared_ptr<FaceValues<dim>> &face_values,
                                const BondPredicate<dim>               &is_cut)
  {
    const SceneParameters &parameters = body.parameters;
    for (const auto &solid : body.solids)
      if (parameters.model.is_correspondence() || parameters.model.is_consistent())
        laws[solid.first] = create_law<dim>(law_of(parameters), solids_of_model(body)(solid.first));
    if (parameters.model.is_consistent())
      weigh_faces(body, face_values, is_cut);
    else if (parameters.model.is_correspondence())
      weigh_correspondence(body);
    else if (parameters.quadrature.has_gauss_points())
      weigh_gauss_points(body);
    else
      weigh_nodes(body, is_cut);
    counts  = bonds->counts;
    reports = bonds->reports;
  }

  template <int dim>
  void DiscreteBody<dim>::weigh_faces(const Body<dim>                        &body,
                                      const std::shared_ptr<FaceValues<dim>> &face_values,
                                      const BondPredicate<dim>               &is_cut)
  {
    const auto solid_of = solids_of_model(body);
    gradients.make_moments(body, face_values);
    consistent_bonds = std::make_shared<ConsistentBonds<dim>>(
      families,
      *gradients.polynomials,
      create_consistent<dim>(body.parameters.model,
                             families->listed() * body.parameters.nodes.horizon_factor),
      solid_of,
      is_cut);
    bonds =
      std::make_shared<ConsistentOperator<dim>>(families, gradients.moments, consistent_bonds, solid_of);
    if (has_fracture_zone(body.parameters))
      model = create_model<dim>(body.parameters.model.in_zone(), body.mesh->thickness);
  }

  template <int dim>
  void DiscreteBody<dim>::expand(const Body<dim>                                 &body,
                                 const std::shared_ptr<const CellExpansion<dim>> &of_cells)
  {
    if (correspondence)
      dynamic_cast<CorrespondenceTangent<dim> &>(*bonds).set_expansion(solids_of_model(body), of_cells);
    else
      dynamic_cast<ConsistentOperator<dim> &>(*bonds).set_expansion(of_cells);
  }

  template <int dim>
  void DiscreteBody<dim>::expand(const Body<dim>                                 &body,
                                 const std::shared_ptr<const CellExpansion<dim>> &of_cells,
                                 BondForce<dim>                                  &force) const
  {
    const auto in_space = laws_in_space(law_of(body.parameters), body.solids);
    if (correspondence)
      dynamic_cast<CorrespondenceForce<dim> &>(force).expand(in_space, of_cells);
    else
      dynamic_cast<ConsistentForce<dim> &>(force).expand(in_space, of_cells);
  }

  template <int dim>
  std::vector<std::pair<dealii::Point<dim>, double>> DiscreteBody<dim>::held_faces() const
  {
    std::vector<std::pair<dealii::Point<dim>, double>> result;
    const auto                                        &points = gradients.moments->faces().boundary_points();
    for (const auto &entry : gradients.moments->prescribed_values().entries())
      result.emplace_back(entry.position, families->spacing[points[entry.point].node]);
    return result;
  }

  template <int dim>
  void DiscreteBody<dim>::weigh_correspondence(const Body<dim> &body)
  {
    correspondence = std::make_shared<CorrespondenceRows<dim>>(
      families, create_correspondence<dim>(body.parameters.model), [&](const dealii::types::material_id id) {
        return body.solids.at(id);
      });
    bonds = std::make_shared<CorrespondenceTangent<dim>>(families, correspondence, laws);
  }

  template <int dim>
  void DiscreteBody<dim>::measure_families(const Body<dim> &body)
  {
    const ComparisonParameters &comparison = body.parameters.comparison;
    if (!comparison.by_families())
      return;
    if (!family_stiffness)
      {
        const PolynomialResponse<dim> response(*bonds, *families);
        std::vector<std::uint8_t>     is_whole(families->n_owned());
        for (LocalIndex i = 0; i < is_whole.size(); ++i)
          is_whole[i] = !response.lacks_bonds(i);
        family_stiffness = response.stiffness(is_whole);
      }
    if (!family_stiffness || body.mesh->material_ids.size() > 1)
      throw InputError(family_stiffness ? "families of several materials have several stiffnesses" :
                                          "no family is whole, from which stiffness could be told")
        .parameter("Comparison/Stiffness")
        .given("families")
        .allowed("material for this scene");
  }

  template <int dim>
  SolidsByMaterial<dim> DiscreteBody<dim>::compared_solids(const Body<dim> &body, const Mesh<dim> &mesh) const
  {
    if (!body.parameters.comparison.by_families())
      return body.solids_on(mesh);
    SolidsByMaterial<dim> result;
    for (const auto id : mesh.material_ids)
      result[id] = elastic_solid<dim>(*family_stiffness);
    return result;
  }

  template <int dim>
  std::unique_ptr<BondForce<dim>> DiscreteBody<dim>::create_force(const Body<dim> &body) const
  {
    if (consistent_bonds)
      {
        auto cells =
          std::make_unique<ConsistentForce<dim>>(families, gradients.moments, consistent_bonds, laws);
        if (!model)
          return cells;
        const auto weigh = [this, &body](const std::shared_ptr<const Families<dim>> &whole) {
          return weigh_bonds<dim>(whole, *model, solids_of_model(body), {{}, true, false});
        };
        return std::make_unique<ZonedForce<dim>>(
          std::move(cells), families, weigh, held_faces(), !body.parameters.nodes.families_on_demand);
      }
    if (correspondence)
      return std::make_unique<CorrespondenceForce<dim>>(families, correspondence, laws);
    return create_bond_force<dim>(*weights);
  }

  template <int dim>
  std::shared_ptr<const Families<dim>> DiscreteBody<dim>::sample_of_whole_families() const
  {
    if (families->is_whole(0))
      return families;
    constexpr LocalIndex n_sampled = 500;
    std::vector<bool>    chosen(families->n_local(), false);
    for (LocalIndex i = 0; i < families->n_owned(); i += 1 + families->n_owned() / n_sampled)
      chosen[i] = true;
    return families->whole_families(families->with_members(chosen));
  }

  template <int dim>
  std::shared_ptr<TangentOperator<dim>> DiscreteBody<dim>::create_tangent() const
  {
    if (consistent_bonds && model)
      return std::make_shared<ZonedTangent<dim>>(std::static_pointer_cast<ConsistentOperator<dim>>(bonds));
    // Of models that follow a law, the operator at rest is the tangent.
    if (const auto tangent = std::dynamic_pointer_cast<TangentOperator<dim>>(bonds); tangent)
      return tangent;
    return perideal::create_tangent<dim>(std::shared_ptr<const BondWeights<dim>>(weights));
  }

  PERIDEAL_INSTANTIATE(solids_of_model)
  PERIDEAL_INSTANTIATE_CLASS(DiscreteBody)
} // namespace perideal
