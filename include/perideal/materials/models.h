// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_models_h
#define perideal_materials_models_h

#include <perideal/materials/consistent.h>
#include <perideal/materials/correspondence.h>
#include <perideal/materials/linear_model.h>
#include <perideal/parameters/elastic_constants.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// The choices of sections "Material" and "Nodes" that say what a bond does.
  struct ModelParameters
  {
    std::string model              = "extended ordinary";
    std::string form               = "automatic";
    std::string influence_function = "automatic";
    std::string stabilisation      = "automatic";
    /// Of the correspondence model: linear elastic | Saint Venant-Kirchhoff | neo-Hookean.
    std::string law = "linear elastic";
    /// intact | after the cut | recomputed: whether multipliers are those of families with the bonds that
    /// precracks cut, and that broke.
    std::string multipliers = "intact";

    /// none | numerical | sphere | closed form: how bonds are stiffened near the surface.
    std::string boundary_compensation = "none";
    /// mean | neighbour: which end's factor a bond has.
    std::string compensation_of_a_bond = "mean";

    /// ordinary | tensor involved: whose critical stretch a fracture energy means.
    std::string stretch_formula = "automatic";

    void declare(dealii::ParameterHandler &prm);

    /// Whether bonds break and move, or are those of linear statics.
    enum class Use
    {
      statics,
      motion
    };

    /// Puts what serves the model best in the place of "automatic".
    /// @throws InputError on a stabilisation that is not a positive number, on a form or multipliers of a
    /// model without.
    void resolve(const int dimension, const Use use = Use::statics);

    /// Takes the strain from the face gradient of the mesh, and boundary conditions at faces.
    bool is_consistent() const { return has_forms() && form == "consistent"; }

    /// Stresses of any law of the continuum; no LinearModel.
    bool is_correspondence() const { return model == "correspondence"; }

    /// Bonds for solids of any symmetry.
    bool is_tensor_involved() const { return model == "tensor involved"; }

    /// Bonds with what they lack at surfaces, by the face gradient.
    bool has_surface_cure() const { return is_tensor_involved() && form == "surface cure"; }

    /// Forms of the model whose bonds can break and move.
    std::vector<std::string> forms_of_motion() const;

    /// Forms that are linear and of statics only.
    bool is_linear_only() const { return (is_consistent() && !is_correspondence()) || has_surface_cure(); }

    bool compensates() const { return boundary_compensation != "none"; }

    bool has_forms() const
    {
      return model == "extended ordinary" || is_tensor_involved() || is_correspondence();
    }

    /// Solids without isotropy.
    bool takes_any_symmetry() const { return is_tensor_involved() || is_correspondence(); }

    /// Names of the model's own forms.
    std::vector<std::string> own_forms() const;

    bool after_the_cut() const { return multipliers != "intact"; }
    bool recomputes() const { return multipliers == "recomputed"; }

    /// The constants that the model has where it cannot have those asked for: a
    /// bond-based body keeps Young's modulus, Poisson's ratio is its own.
    ElasticConstants constants_of_model(const ElasticConstants &constants) const;
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
