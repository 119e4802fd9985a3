// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_traits_h
#define perideal_materials_traits_h

#include <perideal/materials/linear_model.h>
#include <perideal/parameters/elastic_constants.h>
#include <perideal/parameters/listed.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace perideal
{
  struct ModelParameters;

  /**
   * Where the strain of a node comes from, whatever a model makes of it.
   *
   * - families: from the bonds of its family.
   * - faces: from the face gradient of its cell (materials/consistent.h). Every node must have a cell then:
   *   fictitious nodes and nodes on the surface have none. Cracks grow where bonds of families take the place
   *   of cells (operators/force/zoned_force.h), if the model has such. Displacements and tractions are taken
   *   at faces, the horizon may have the shape of the cells, and bonds only stabilise, for which whole cells
   *   serve.
   */
  enum class Discretisation
  {
    families,
    faces
  };

  /// The solvers that a form serves besides linear statics.
  struct Solvers
  {
    bool quasi_statics = true, relaxation = true, dynamics = true;
  };

  /// Creates a model of bonds. Arguments are those of create_model().
  template <int dim>
  using CreateModel = std::unique_ptr<LinearModel<dim>> (*)(const ModelParameters     &parameters,
                                                            const double               thickness,
                                                            const std::vector<double> &stiffening);

  /// What one form of a model is, as Material/Form names it.
  struct FormTraits
  {
    /// Name, and for lists of parameters the rest of "NAME: ..."; empty where the model has one form only.
    std::string    name, meaning;
    Discretisation discretisation = Discretisation::families;
    Solvers        solvers;

    /// The state of its families; none where the form has no LinearModel.
    std::optional<FamilyShape> shape;
    /// Creates the model in 2-D and 3-D; null where the form has no LinearModel.
    std::tuple<CreateModel<2>, CreateModel<3>> create = {};

    /// Forces are the gradient of an energy, and the operator is symmetric.
    bool follows_from_energy = true;
    /// A bond's force follows from its own two ends (LinearModel::pair_force()).
    bool bonds_know_only_their_ends = false;
    /// Weights are made for each family as its nodes stand: whole cells count as well as parts of them.
    bool is_made_for_each_family = true;
    /// Weights have multipliers, which a cut through the family changes (Material/Multipliers).
    bool has_multipliers = false;
    /// Bonds are given what they lack at surfaces by the face gradient (operators/linear/surface_cure.h).
    bool has_surface_cure = false;

    /// What "automatic" stands for.
    struct Defaults
    {
      /// Of Nodes/Influence function.
      std::string influence_function = "constant";
      /// Of Material/Stabilisation, in 2-D and 3-D [-]; 0: nothing is stabilised.
      std::array<double, 2> stabilisation = {{0., 0.}};
      /// The same in dynamics, where it bounds the time step too; 0: that at rest.
      std::array<double, 2> stabilisation_in_motion = {{0., 0.}};
      /// Horizon over spacing that its bonds have whatever Nodes/Horizon factor says; 0: they have that [-].
      double horizon_factor = 0.;
    };
    Defaults defaults;
  };

  /// Stretch at which bonds of a material break, so that opening a unit of crack surface takes the fracture
  /// energy [-]: the energy of all bonds that cross a plane is G0 then.
  /// @param fracture_energy G0 [J/m^2]
  /// @param horizon [m]
  using CriticalStretch = double (*)(const ElasticConstants &constants,
                                     const double            fracture_energy,
                                     const double            horizon);

  /**
   * What a model says of itself, in its own file. Code that is the same for all models asks this, never which
   * model it has.
   */
  struct ModelTraits
  {
    /// Name, and for lists of parameters the rest of "NAME: ...".
    std::string name, meaning;

    std::vector<FormTraits> forms;

    /// Which of them "automatic" stands for: in linear statics, in motion and along load steps, and where
    /// bonds break.
    struct DefaultForms
    {
      /// In linear statics, where nothing breaks, and along load steps where something can.
      std::string statics, motion, failure;
      /// In motions where something can break, and where a scene asks for what the form for failure does not
      /// have.
      std::string otherwise;
      /// The form of the bonds that the consistent form turns into where cracks may grow; empty: it has none.
      /// The model whose form that is; empty: this one.
      std::string in_zone = {}, in_zone_of = {};
    };
    DefaultForms default_forms;

    /// Solids without isotropy are welcome.
    bool takes_any_symmetry = false;
    /// Stresses follow any law of the continuum (Material/Law), at large strain too.
    bool has_law = false;
    /// The Poisson's ratio that bonds alone have; null: the solid's own.
    double (*poisson_ratio)(const PlaneAssumption) = nullptr;

    /// Null where bonds break by stress.
    CriticalStretch critical_stretch = nullptr;

    /// Families that the surface cuts are made up for; else bodies are too soft there.
    bool corrects_surfaces = true;
    /// Bonds are springs of one micromodulus at all lengths, of which the stiffening at surfaces
    /// (Material/Boundary compensation), the Gauss points (Quadrature/Scheme) and the closed form of
    /// boundary forces (Traction treatment = line to point) are made.
    bool has_one_micromodulus = false;
    /// Bonds have tensors for stiffness: they pull sideways, and do not turn freely.
    bool has_bond_tensors = false;

    /// Declares parameters that this model alone has; null: none. Called in section "Material".
    void (*declare)(dealii::ParameterHandler &prm, ModelParameters &parameters) = nullptr;
  };

  /// One of the list of models.
  using ModelChoice = Listed<ModelTraits>;
  /// @cond
  template <>
  const Registry<ModelTraits> &ModelChoice::list();
  /// @endcond
} // namespace perideal

#endif
