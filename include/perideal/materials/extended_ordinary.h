// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_extended_ordinary_h
#define perideal_materials_extended_ordinary_h

#include <perideal/materials/influence_function.h>
#include <perideal/materials/linear_model.h>
#include <perideal/materials/moment_conditions.h>

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Extended ordinary state-based peridynamics for families of any shape
   * (Liu, Chen, Skelton; "XOSB"), small strain.
   *
   *     theta = sum_j wh |xi| e V_j                              (26)
   *     W     = kappa/2 theta^2 + mu sum_j wd (e^d)^2 V_j        (22)
   *     e^d   = e - theta |xi|/dim                               (20)
   *
   * wh and wd meet the moment conditions of order 2 and 4, so that theta and W
   * are exact under uniform strain in families of any shape.
   */
  template <int dim>
  class ExtendedOrdinary : public LinearModel<dim>
  {
  public:
    /// Which force state goes with the energy above.
    enum class Form
    {
      /// t = kappa wh |xi| theta + 2 mu wd e^d (70), with spherical weights in
      /// the force of families that have a negative wh (end of section 3.3).
      /// Not the gradient of W.
      paper,
      /// The gradient of W, with wd made non-negative where it is not; where no
      /// non-negative wd meets the conditions, the spherical ones scaled to their trace.
      energy
    };

    /// What becomes of families with negative weights.
    enum class Negative
    {
      /// What the form says.
      by_form,
      /// Spherical weights in theta and force wherever any wh or wd is negative or a condition is missed.
      /// Families that a cut has made one-sided have many such, which would let deformation gain energy.
      spherical
    };

    /// The paper's force follows from theta alone; the energy's also needs q = sum_j wd e^d |xi| V_j.
    static FamilyShape family_shape(const Form form)
    {
      return form == Form::paper ? FamilyShape{1, true} : FamilyShape{2, false};
    }

    ExtendedOrdinary(const Form               form,
                     const InfluenceFunction &influence,
                     const double             thickness,
                     const Negative           negative = Negative::by_form);

    FamilyShape shape() const override { return family_shape(form); }
    bool        is_symmetric() const override { return form == Form::energy; }
    void        compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override;

    /// The weights wh and wd of a family and what became of them; wd is
    /// non-negative in the energy form, both are with Negative::spherical.
    FamilyReport weigh(const FamilyView<dim> &family, std::vector<double> &wh, std::vector<double> &wd);

  private:
    void compute_paper(const FamilyView<dim> &family, FamilyCoefficients &coefficients) const;
    void compute_energy(const FamilyView<dim> &family, FamilyCoefficients &coefficients) const;

    Form              form;
    InfluenceFunction influence;
    double            thickness;
    Negative          negative;

    // Work space of one family.
    MomentConditions<dim, 2> hydrostatic_conditions;
    MomentConditions<dim, 4> deviatoric_conditions;
    std::vector<double>      spherical, spherical_deviatoric, wh, wd;
  };
} // namespace perideal

#endif
