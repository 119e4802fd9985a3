// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/materials/influence_function.h>
#include <perideal/materials/models.h>
#include <perideal/materials/ordinary.h>
#include <perideal/materials/tensor_involved.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

/// The list of models: a new one is one file, with its traits in a function of this name, and one line here.
#define PERIDEAL_MODELS(MODEL)                                                                               \
  MODEL(bond_based)                                                                                          \
  MODEL(conical_bond_based)                                                                                  \
  MODEL(ordinary)                                                                                            \
  MODEL(extended_ordinary)                                                                                   \
  MODEL(tensor_involved)                                                                                     \
  MODEL(correspondence)

namespace perideal
{
  namespace models
  {
#define PERIDEAL_DECLARE(name) ModelTraits name();
    PERIDEAL_MODELS(PERIDEAL_DECLARE)
  } // namespace models

  template <>
  const Registry<ModelTraits> &ModelChoice::list()
  {
#define PERIDEAL_TRAITS(name) models::name(),
    static const auto models =
      list_by_name<ModelTraits>("Material/Model", {PERIDEAL_MODELS(PERIDEAL_TRAITS)});
    return models;
  }

  namespace
  {
    /// What a choice is called that resolve() makes.
    const std::string automatic = "automatic";

    /// Names of a model's forms.
    std::vector<std::string> form_names(const ModelTraits &model)
    {
      std::vector<std::string> result;
      for (const FormTraits &form : model.forms)
        result.push_back(form.name);
      return result;
    }

    /// The pattern of Material/Form: what the models have, each name once.
    std::string pattern_of_forms()
    {
      std::vector<std::string> names = {"automatic"};
      for (const auto &[name, model] : ModelChoice::list())
        if (model.forms.size() > 1)
          for (const std::string &form : form_names(model))
            if (std::count(names.begin(), names.end(), form) == 0)
              names.push_back(form);
      return join_choices(names, "|");
    }

    /// "MODEL: NAME: MEANING; NAME: MEANING. MODEL: ..." of what models have of their own.
    std::string meanings_of_forms()
    {
      std::string result;
      for (const auto &[name, model] : ModelChoice::list())
        {
          std::vector<std::string> texts;
          for (const FormTraits &form : model.forms)
            if (form.discretisation == Discretisation::families && !form.meaning.empty())
              texts.push_back(form.name + ": " + form.meaning);
          if (texts.empty())
            continue;
          std::string heading = name;
          heading.front()     = static_cast<char>(std::toupper(heading.front()));
          result += ". " + heading + ": " + join_choices(texts, "; ");
        }
      return result;
    }
  } // namespace

  void ModelParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Selection;
    prm.enter_subsection("Material");
    prm.add_parameter("Model", model, "What a bond does: " + meanings_of<ModelTraits>());
    prm.add_parameter(
      "Form",
      form,
      "Force of the extended ordinary, the tensor involved and the correspondence model: automatic: "
      "consistent in statics, for correspondence where nothing breaks and for the extended ordinary model in "
      "load steps where something can, unless the scene asks for what it does not have; else energy, moment "
      "corrected or family; consistent: strain from the faces of the mesh, bonds stabilise, symmetric, the "
      "most "
      "accurate, "
      "with sharp precracks; where bonds soften by a Failure criterion, and in motion or load steps of the "
      "extended ordinary model, cracks grow in it: there it turns into the energy form" +
        meanings_of_forms(),
      Selection(pattern_of_forms()));
    prm.add_parameter(
      "Stretch formula",
      stretch_formula,
      "Critical stretch that a fracture energy means: automatic: bonds where they soften, else published; "
      "bonds: "
      "that for which the bonds across a crack, as they stand, take the fracture energy as they fail, in any "
      "direction, with any influence function and Poisson's ratio, at surfaces too; by formulas for round "
      "families of many bonds: published: the model's own; ordinary: that of state-based bonds; tensor "
      "involved: that of bonds with tensors, for that model");
    declare_stabilisation(prm, *this);
    for (const auto &[name, traits] : ModelChoice::list())
      if (traits.declare)
        traits.declare(prm, *this);
    prm.leave_subsection();

    prm.enter_subsection("Nodes");
    prm.add_parameter(
      "Influence function",
      influence_function,
      "How much a bond counts by its length over the horizon: 1, 1/s, exp(-(2s)^2), or the cubic "
      "B-spline that vanishes at s = 1; automatic: the spline for the consistent form, else constant",
      Selection("automatic|" + join_choices(InfluenceFunction::names(), "|")));
    prm.leave_subsection();
  }

  void ModelParameters::resolve(const int dimension, const Use use, const bool moves)
  {
    if (form == automatic)
      {
        const auto &forms = model->default_forms;
        form              = use == Use::statics                              ? forms.statics :
                            use == Use::motion                               ? forms.motion :
                            use == Use::stress_onset && grows_by_softening() ? consistent_form().name :
                            moves                                            ? forms.otherwise :
                                                                               forms.failure;
      }
    const FormTraits &traits = form_traits();
    if (influence_function == automatic)
      influence_function = traits.defaults.influence_function;
    double of_form = traits.defaults.stabilisation[dimension - 2];
    if (const double in_motion = traits.defaults.stabilisation_in_motion[dimension - 2];
        moves && in_motion > 0)
      of_form = in_motion;
    if (stabilisation == automatic && of_form > 0)
      stabilisation = std::to_string(of_form);
  }

  ModelParameters ModelParameters::in_zone() const
  {
    ModelParameters result = *this;
    result.form            = model->default_forms.in_zone;
    if (!model->default_forms.in_zone_of.empty())
      result.model = model->default_forms.in_zone_of;
    if (influence_function == form_traits().defaults.influence_function)
      result.influence_function = result.form_traits().defaults.influence_function;
    return result;
  }

  const FormTraits &ModelParameters::form_traits() const
  {
    static const FormTraits none;
    if (!has_forms())
      return model->forms.front();
    for (const FormTraits &traits : model->forms)
      if (traits.name == form)
        return traits;
    return none;
  }

  ElasticConstants ModelParameters::constants_of_model(const ElasticConstants &constants) const
  {
    ElasticConstants result = constants;
    if (model->poisson_ratio)
      result.poisson_ratio = model->poisson_ratio(constants.assumption);
    return result;
  }

  double ModelParameters::critical_stretch(const ElasticConstants &given,
                                           const double            fracture_energy,
                                           const double            horizon) const
  {
    const CriticalStretch formula = stretch_formula == StretchFormula::ordinary ? ordinary_critical_stretch :
                                    stretch_formula == StretchFormula::tensor_involved ?
                                                                                  tensor_critical_stretch :
                                                                                  model->critical_stretch;
    return formula(constants_of_model(given), fracture_energy, horizon);
  }

  template <int dim>
  Consistent<dim> create_consistent(const ModelParameters &parameters, const double horizon_factor)
  {
    return Consistent<dim>(InfluenceFunction(parameters.influence_function),
                           std::strtod(parameters.stabilisation.c_str(), nullptr),
                           horizon_factor);
  }

  template <int dim>
  Correspondence<dim> create_correspondence(const ModelParameters &parameters)
  {
    return Correspondence<dim>(InfluenceFunction(parameters.influence_function),
                               std::strtod(parameters.stabilisation.c_str(), nullptr));
  }

  template <int dim>
  std::unique_ptr<LinearModel<dim>> create_model(const ModelParameters     &parameters,
                                                 const double               thickness,
                                                 const std::vector<double> &stiffening)
  {
    const auto create = std::get<CreateModel<dim>>(parameters.form_traits().create);
    AssertThrow(create, dealii::ExcMessage("this form has no LinearModel"));
    return create(parameters, thickness, stiffening);
  }

  PERIDEAL_INSTANTIATE(create_consistent)
  PERIDEAL_INSTANTIATE(create_correspondence)
  PERIDEAL_INSTANTIATE(create_model)
} // namespace perideal
