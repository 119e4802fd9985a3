// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/materials/bond_based.h>
#include <perideal/materials/extended_ordinary.h>
#include <perideal/materials/influence_function.h>
#include <perideal/materials/models.h>
#include <perideal/materials/ordinary.h>
#include <perideal/materials/tensor_involved.h>
#include <perideal/parameters/hyperelastic_law.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace perideal
{
  namespace
  {
    template <int dim>
    using Factory = std::unique_ptr<LinearModel<dim>> (*)(const ModelParameters &,
                                                          const double,
                                                          const std::vector<double> &);

    /// The list of models: a new one is one file and one line here.
    template <int dim>
    const Registry<Factory<dim>> &models()
    {
      static const Registry<Factory<dim>> list(
        "Material/Model",
        {{"bond based",
          [](const ModelParameters &, const double thickness, const std::vector<double> &stiffening)
            -> std::unique_ptr<LinearModel<dim>> {
            return std::make_unique<BondBased<dim>>(thickness, stiffening);
          }},
         {"ordinary",
          [](const ModelParameters &p, const double thickness, const std::vector<double> &)
            -> std::unique_ptr<LinearModel<dim>> {
            return std::make_unique<Ordinary<dim>>(InfluenceFunction(p.influence_function), thickness);
          }},
         {"extended ordinary",
          [](const ModelParameters &p, const double thickness, const std::vector<double> &)
            -> std::unique_ptr<LinearModel<dim>> {
            return std::make_unique<ExtendedOrdinary<dim>>(ExtendedOrdinary<dim>::form_of(p.form),
                                                           InfluenceFunction(p.influence_function),
                                                           thickness,
                                                           p.after_the_cut() ?
                                                             ExtendedOrdinary<dim>::Negative::spherical :
                                                             ExtendedOrdinary<dim>::Negative::by_form);
          }},
         {"tensor involved",
          [](const ModelParameters &p, const double thickness, const std::vector<double> &)
            -> std::unique_ptr<LinearModel<dim>> {
            using Moments = typename TensorInvolved<dim>::Moments;
            return std::make_unique<TensorInvolved<dim>>(
              p.form == "one point" ? Moments::sphere : Moments::family, thickness);
          }}});
      return list;
    }

    std::string selection(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : "|") + name;
      return text;
    }
  } // namespace

  void ModelParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Selection;
    prm.enter_subsection("Material");
    prm.add_parameter("Model",
                      model,
                      "What a bond does: bond based: springs, whose Poisson's ratio is 1/4 (plane stress "
                      "1/3); ordinary: state-based peridynamics without corrections; extended "
                      "ordinary: with multipliers that make families of any shape exact for uniform strain; "
                      "tensor involved: springs with tensors for stiffness, for solids of any symmetry; "
                      "correspondence: non-ordinary, the stresses of any Law, at large strain too",
                      Selection(selection(models<2>().names()) + "|correspondence"));
    prm.add_parameter("Law",
                      law,
                      "Correspondence: stress by deformation: linear elastic: small strains; Saint "
                      "Venant-Kirchhoff: linear in Green's strain; neo-Hookean: compressible, of isotropic "
                      "materials",
                      Selection(selection(law_names())));
    prm.add_parameter(
      "Form",
      form,
      "Force of the extended ordinary, the tensor involved and the correspondence model: "
      "automatic: consistent "
      "in statics and for correspondence where nothing breaks, else energy, "
      "moment corrected or family; consistent: strain from the faces of the mesh, bonds "
      "stabilise, symmetric, the most accurate in statics. Extended ordinary: energy: the "
      "gradient of the strain "
      "energy over bonds, symmetric; paper: as published, not the gradient of an energy, "
      "non-symmetric. Tensor "
      "involved: one point: as published, made for full spheres; moment corrected: made for "
      "each family as its "
      "nodes stand; surface cure: that, with what bonds lack at free surfaces, in statics. Correspondence: "
      "family: the deformation gradient by the bonds of the family, as published",
      Selection("automatic|consistent|" + selection(ExtendedOrdinary<2>::form_names()) + "|" +
                selection(TensorInvolved<2>::form_names()) + "|family"));
    prm.add_parameter("Stabilisation",
                      stabilisation,
                      "Consistent form: factor of the bonds' energy, > 0 [-]; automatic: 1.1 in 2-D, 0.5 "
                      "in 3-D, where errors are smallest. Correspondence: alpha of the penalty over Young's "
                      "modulus, >= 0 [-], 0: none; automatic: 5 with Form = family, as published, else 0.5");
    prm.add_parameter(
      "Multipliers",
      multipliers,
      "Multipliers of the extended ordinary model where precracks cut bonds: intact: those of "
      "the whole families; after the cut: those of what is left of them, with spherical "
      "weights in families where any weight would be negative; recomputed: the same again and again as "
      "bonds break (energy form in dynamics; slower, and the energy is kept less well)",
      Selection("intact|after the cut|recomputed"));
    prm.add_parameter("Boundary compensation",
                      boundary_compensation,
                      "Bond based: how bonds near the surface are stiffened, so that an expansion stores as "
                      "much energy there as "
                      "inside: none; numerical: by what the quadrature makes of a family in a regular body "
                      "over what it makes of this one; "
                      "sphere: by the integral over the sphere over that, which makes up for the "
                      "quadrature's error inside the body too; "
                      "closed form: by the depth below the planes of the surface",
                      Selection("none|numerical|sphere|closed form"));
    prm.add_parameter("Compensation of a bond",
                      compensation_of_a_bond,
                      "Which factor a bond has: mean: that of both ends; neighbour: that of the far end, as "
                      "published, which leaves forces without balance (Scheme = gauss points)",
                      Selection("mean|neighbour"));
    prm.add_parameter(
      "Stretch formula",
      stretch_formula,
      "Critical stretch that a fracture energy means: automatic: the model's own; ordinary: that of "
      "state-based bonds; tensor involved: that of bonds with tensors, for that model",
      Selection("automatic|ordinary|tensor involved"));
    prm.leave_subsection();

    prm.enter_subsection("Nodes");
    prm.add_parameter(
      "Influence function",
      influence_function,
      "How much a bond counts by its length over the horizon: 1, 1/s, exp(-(2s)^2), or the cubic "
      "B-spline that vanishes at s = 1; automatic: the spline for the consistent form, else constant",
      Selection("automatic|" + selection(InfluenceFunction::names())));
    prm.leave_subsection();
  }

  void ModelParameters::resolve(const int dimension, const Use use)
  {
    if (form == "automatic")
      form = use == Use::statics || is_correspondence() ? "consistent" :
             is_tensor_involved()                       ? "moment corrected" :
                                                          "energy";
    const auto own = own_forms();
    if (has_forms() && form != "consistent" && std::count(own.begin(), own.end(), form) == 0)
      throw InputError("this is no form of the model")
        .parameter("Material/Form")
        .given(form)
        .allowed("automatic | " + (is_correspondence() ? "" : std::string("consistent | ")) +
                 join_choices(own) + " for Model = " + model);
    if (law != "linear elastic" && !is_correspondence())
      throw InputError("the bonds of this model have no law of the continuum")
        .parameter("Material/Law")
        .given(law)
        .allowed("linear elastic for Model = " + model)
        .hint("or set Material/Model = correspondence");
    if (stretch_formula == "automatic")
      stretch_formula = is_tensor_involved() ? "tensor involved" : "ordinary";
    if (stretch_formula == "tensor involved" && !is_tensor_involved())
      throw InputError("the bonds of this model have no tensors")
        .parameter("Material/Stretch formula")
        .given(stretch_formula)
        .allowed("automatic | ordinary for Model = " + model);
    if (compensates() && model != "bond based")
      throw InputError("only springs are stiffened near the surface")
        .parameter("Material/Boundary compensation")
        .given(boundary_compensation)
        .allowed("none for Model = " + model);
    if (compensation_of_a_bond != "mean" && !compensates())
      throw InputError("no bond has a factor")
        .parameter("Material/Compensation of a bond")
        .given(compensation_of_a_bond)
        .allowed("mean; or set Material/Boundary compensation = numerical | closed form");
    if (influence_function == "automatic")
      influence_function = is_correspondence() ? Correspondence<2>::published_influence :
                           is_consistent()     ? Consistent<2>::best_influence :
                                                 "constant";
    if (stabilisation == "automatic" && is_correspondence())
      stabilisation = std::to_string(is_consistent() ? Correspondence<2>::best_stabilisation :
                                                       Correspondence<2>::published_stabilisation);
    if (stabilisation == "automatic")
      stabilisation = std::to_string(dimension == 2 ? Consistent<2>::best_stabilisation :
                                                      Consistent<3>::best_stabilisation);
    if (after_the_cut() && (model != "extended ordinary" || is_consistent()))
      throw InputError("this model has no multipliers that a cut could change")
        .parameter("Material/Multipliers")
        .given(multipliers)
        .allowed("intact; or set Material/Model = extended ordinary with Form = energy | paper");
    if (recomputes() && form != "energy")
      throw InputError("weights that change as bonds break need a force that follows from an energy")
        .parameter("Material/Multipliers")
        .given(multipliers)
        .allowed("intact | after the cut; or set Material/Form = energy");
    char        *end        = nullptr;
    const double value      = std::strtod(stabilisation.c_str(), &end);
    const bool   may_vanish = is_correspondence();
    if (stabilisation.empty() || *end != 0 || !(may_vanish ? value >= 0 : value > 0) || !std::isfinite(value))
      throw InputError("the stabilisation is out of range")
        .parameter("Material/Stabilisation")
        .given(stabilisation)
        .allowed(may_vanish ?
                   "automatic, or a number >= 0" :
                   "automatic, or a number > 0; without it the consistent form has modes without energy");
  }

  std::vector<std::string> ModelParameters::own_forms() const
  {
    return is_correspondence()  ? Correspondence<2>::form_names() :
           is_tensor_involved() ? TensorInvolved<2>::form_names() :
                                  ExtendedOrdinary<2>::form_names();
  }

  std::vector<std::string> ModelParameters::forms_of_motion() const
  {
    return is_tensor_involved() ? std::vector<std::string>{"one point", "moment corrected"} :
                                  ExtendedOrdinary<2>::form_names();
  }

  ElasticConstants ModelParameters::constants_of_model(const ElasticConstants &constants) const
  {
    ElasticConstants result = constants;
    if (model == "bond based")
      result.poisson_ratio = BondBased<2>::poisson_ratio(constants.assumption);
    return result;
  }

  template <int dim>
  Consistent<dim> create_consistent(const ModelParameters &parameters, const double horizon_factor)
  {
    return Consistent<dim>(
      InfluenceFunction(parameters.influence_function), std::stod(parameters.stabilisation), horizon_factor);
  }

  template <int dim>
  Correspondence<dim> create_correspondence(const ModelParameters &parameters)
  {
    return Correspondence<dim>(InfluenceFunction(parameters.influence_function),
                               std::stod(parameters.stabilisation));
  }

  template <int dim>
  std::unique_ptr<LinearModel<dim>> create_model(const ModelParameters     &parameters,
                                                 const double               thickness,
                                                 const std::vector<double> &stiffening)
  {
    return models<dim>().get(parameters.model)(parameters, thickness, stiffening);
  }

  PERIDEAL_INSTANTIATE(create_consistent)
  PERIDEAL_INSTANTIATE(create_correspondence)
  PERIDEAL_INSTANTIATE(create_model)
} // namespace perideal
