// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_models_h
#define perideal_materials_models_h

#include <perideal/materials/consistent.h>
#include <perideal/materials/correspondence.h>
#include <perideal/materials/linear_model.h>
#include <perideal/materials/traits.h>
#include <perideal/parameters/choice.h>
#include <perideal/parameters/elastic_constants.h>
#include <perideal/parameters/hyperelastic_law.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// Of which families multipliers are: the whole ones, or those without the bonds that precracks cut, or
  /// without those that broke as well.
  enum class Multipliers
  {
    intact,
    after_the_cut,
    recomputed
  };

  template <>
  struct ChoiceNames<Multipliers>
  {
    static constexpr const char *list[] = {"intact", "after the cut", "recomputed"};
  };

  /// How bonds are stiffened near the surface.
  enum class BoundaryCompensation
  {
    none,
    numerical,
    sphere,
    closed_form
  };

  template <>
  struct ChoiceNames<BoundaryCompensation>
  {
    static constexpr const char *list[] = {"none", "numerical", "sphere", "closed form"};
  };

  /// Which end's factor a stiffened bond has.
  enum class CompensationOfABond
  {
    mean,
    neighbour
  };

  template <>
  struct ChoiceNames<CompensationOfABond>
  {
    static constexpr const char *list[] = {"mean", "neighbour"};
  };

  /// Whose critical stretch a fracture energy means: that of the bonds as they stand, or of a formula.
  enum class StretchFormula
  {
    automatic,
    bonds,
    published,
    ordinary,
    tensor_involved
  };

  template <>
  struct ChoiceNames<StretchFormula>
  {
    static constexpr const char *list[] = {"automatic", "bonds", "published", "ordinary", "tensor involved"};
  };

  /// The choices of sections "Material" and "Nodes" that say what a bond does.
  struct ModelParameters
  {
    ModelChoice model              = "extended ordinary";
    std::string form               = "automatic";
    std::string influence_function = "automatic";
    std::string stabilisation      = "automatic";
    /// Of models that follow a law.
    LawChoice            law                    = "linear elastic";
    Multipliers          multipliers            = Multipliers::intact;
    BoundaryCompensation boundary_compensation  = BoundaryCompensation::none;
    CompensationOfABond  compensation_of_a_bond = CompensationOfABond::mean;
    StretchFormula       stretch_formula        = StretchFormula::automatic;

    void declare(dealii::ParameterHandler &prm);

    /// Whether bonds are those of linear statics, move or follow load steps, break, or begin to soften by
    /// stress.
    enum class Use
    {
      statics,
      motion,
      failure,
      stress_onset
    };

    /// Puts what serves the model best in the place of "automatic".
    /// @param moves whether the scene is one of dynamics
    void resolve(const int dimension, const Use use = Use::statics, const bool moves = false);

    /// What the chosen form says of itself; as long as it is "automatic", or none of the model, what forms
    /// are unless they say otherwise.
    const FormTraits &form_traits() const;

    Discretisation discretisation() const { return form_traits().discretisation; }

    /// The model of the bonds that the consistent form turns into where cracks may grow, of resolved
    /// parameters: of the model's form for this, with the influence function of that form where the
    /// consistent form has its own.
    ModelParameters in_zone() const;

    /// Whether cracks of softening bonds grow in the consistent form of the model, which has it then.
    bool grows_by_softening() const { return !model->default_forms.in_zone.empty(); }

    /// The name of the chosen form; empty where the model has one only.
    std::string form_name() const { return has_forms() ? form : std::string(); }

    /// Takes the strain from the face gradient of the mesh, and boundary conditions at faces.
    bool is_consistent() const { return discretisation() == Discretisation::faces; }

    /// Stresses of any law of the continuum; no LinearModel.
    bool is_correspondence() const { return model->has_law; }

    /// Bonds that pull sideways, and do not turn freely.
    bool is_tensor_involved() const { return model->has_bond_tensors; }

    /// Has strains from the faces of cells, and no force that is one of bonds alone.
    bool has_cell_strains() const { return is_consistent() || has_surface_cure(); }

    /// Bonds with what they lack at surfaces, by the face gradient.
    bool has_surface_cure() const { return form_traits().has_surface_cure; }

    /// Serves linear statics only.
    bool is_linear_only() const { return !form_traits().solvers.quasi_statics; }

    bool compensates() const { return boundary_compensation != BoundaryCompensation::none; }

    bool has_forms() const { return model->forms.size() > 1; }

    /// Solids without isotropy.
    bool takes_any_symmetry() const { return model->takes_any_symmetry; }

    bool after_the_cut() const { return multipliers != Multipliers::intact; }
    bool recomputes() const { return multipliers == Multipliers::recomputed; }

    /// The constants that the model has where it cannot have those asked for: a
    /// bond-based body keeps Young's modulus, Poisson's ratio is its own.
    ElasticConstants constants_of_model(const ElasticConstants &constants) const;

    /// Whether critical stretches follow from the energy of the bonds as they stand; of resolved parameters.
    bool calibrates_bonds() const { return stretch_formula == StretchFormula::bonds; }

    /// The critical stretch [-] that a fracture energy means by a formula, of a model that breaks by stretch:
    /// its own, where neither of the two others is asked for.
    /// @param given constants of the (nearest isotropic) solid
    /// @param fracture_energy [J/m^2]
    /// @param horizon [m]
    double
    critical_stretch(const ElasticConstants &given, const double fracture_energy, const double horizon) const;
  };

  /// The consistent form, of resolved parameters.
  /// @param horizon_factor horizon over spacing [-]
  template <int dim>
  Consistent<dim> create_consistent(const ModelParameters &parameters, const double horizon_factor);

  /// The correspondence model, of resolved parameters.
  template <int dim>
  Correspondence<dim> create_correspondence(const ModelParameters &parameters);

  /// Any other model, of resolved parameters.
  /// @param thickness of a two-dimensional body [m], 1 in 3-D
  /// @param stiffening factors of the bond-based model's micromodulus by owned node; empty: none
  template <int dim>
  std::unique_ptr<LinearModel<dim>> create_model(const ModelParameters     &parameters,
                                                 const double               thickness,
                                                 const std::vector<double> &stiffening = {});
} // namespace perideal

#endif
