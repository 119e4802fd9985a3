// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/hyperelastic_law.h>

/// The list of laws: a new one is one file, with its traits in a function of this name, and one line here.
#define PERIDEAL_LAWS(LAW)                                                                                   \
  LAW(linear_elastic)                                                                                        \
  LAW(saint_venant_kirchhoff)                                                                                \
  LAW(neo_hookean)                                                                                           \
  LAW(hencky)

namespace perideal
{
  namespace laws
  {
#define PERIDEAL_DECLARE(name) LawTraits name();
    PERIDEAL_LAWS(PERIDEAL_DECLARE)
  } // namespace laws

  template <>
  const Registry<LawTraits> &LawChoice::list()
  {
#define PERIDEAL_TRAITS(name) laws::name(),
    static const auto laws = list_by_name<LawTraits>("Material/Law", {PERIDEAL_LAWS(PERIDEAL_TRAITS)});
    return laws;
  }

  template <int dim>
  std::shared_ptr<const HyperelasticLaw<dim>> create_law(const LawChoice &law, const ElasticSolid<dim> &solid)
  {
    if (!solid.is_isotropic() && !law->takes_any_symmetry)
      {
        std::vector<std::string> others;
        for (const auto &[name, traits] : LawChoice::list())
          if (traits.takes_any_symmetry)
            others.push_back(name);
        throw InputError("this law is one of isotropic materials")
          .parameter("Material/Law")
          .given(law->name)
          .allowed(join_choices(others) + " for this symmetry");
      }
    return std::get<CreateLaw<dim>>(law->create)(solid);
  }

  PERIDEAL_INSTANTIATE(create_law)
} // namespace perideal
