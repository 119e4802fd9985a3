// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_read_scene_h
#define perideal_application_read_scene_h

#include <perideal/problem/scene_parameters.h>

namespace perideal
{
  /// Declares all parameters, reads the values, looks at each of them, puts what they mean in the place of
  /// "automatic" and applies the table of rules. The blocks of @p scene are bound to @p prm: it must stay
  /// where it is.
  /// @throws InputError or InputErrors on all mistakes that were found, with file, line and parameter.
  void read_scene(const ParameterFile &file, dealii::ParameterHandler &prm, SceneParameters &scene);

  /// Puts what they mean for the scene in the place of "automatic" choices; a warning of the scene says where
  /// the form is not the usual one, because of what the scene asks for besides. Says nothing else about
  /// choices that do not go together.
  void resolve(SceneParameters &scene);
} // namespace perideal

#endif
