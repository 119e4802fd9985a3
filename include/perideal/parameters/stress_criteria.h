// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_stress_criteria_h
#define perideal_parameters_stress_criteria_h

#include <perideal/parameters/listed.h>

#include <deal.II/base/symmetric_tensor.h>

#include <string>

namespace perideal
{
  /// What a criterion of brittle failure says of itself, in stress_criteria.cc.
  struct StressCriterionTraits
  {
    /// Name, and for lists of parameters the rest of "NAME: ...".
    std::string name, meaning;
    /// Compression counts, by Material/Compressive strength.
    bool has_compressive_strength = false;

    /// How close a stress is to the one at which the material fails: from 1 on [-]. It is proportional to the
    /// stress, and not positive where all principal stresses are pressures that the criterion does not count.
    /// Null: nothing fails.
    /// @param stress Cauchy's, in space [Pa]
    /// @param tensile_strength f_t > 0 in uniaxial tension [Pa]
    /// @param compressive_strength f_c >= f_t in uniaxial compression [Pa], where that counts
    double (*utilisation)(const dealii::SymmetricTensor<2, 3> &stress,
                          const double                         tensile_strength,
                          const double                         compressive_strength) = nullptr;
  };

  using FailureCriterion = Listed<StressCriterionTraits>;
  /// @cond
  template <>
  const Registry<StressCriterionTraits> &FailureCriterion::list();
  /// @endcond

  /// The criterion of a material with its strengths.
  class StressCriterion
  {
  public:
    /// Nothing fails.
    StressCriterion() = default;

    /// @param criterion not "none"
    /// @param tensile_strength f_t > 0 [Pa]
    /// @param compressive_strength f_c >= f_t [Pa], where the criterion has one
    StressCriterion(const FailureCriterion &criterion,
                    const double            tensile_strength,
                    const double            compressive_strength);

    /// Whether any stress reaches it.
    bool can_fail() const { return criterion->utilisation != nullptr; }

    /// Fails from 1 on [-].
    /// @param stress Cauchy's, in space [Pa]
    double utilisation(const dealii::SymmetricTensor<2, 3> &stress) const
    {
      return can_fail() ? criterion->utilisation(stress, tensile, compressive) : 0.;
    }

  private:
    FailureCriterion criterion = "none";
    double           tensile = 0., compressive = 0.;
  };

  struct MaterialParameters;
  struct MaterialProperties;

  /// The criterion of one material of a scene; nothing fails without a criterion or a tensile strength.
  StressCriterion stress_criterion(const MaterialParameters &parameters, const MaterialProperties &material);
} // namespace perideal

#endif
