// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_output_fields_h
#define perideal_problem_output_fields_h

#include <perideal/output/field_sink.h>

#include <string>
#include <vector>

namespace perideal
{
  template <int dim>
  struct Problem;

  /// Names that Output/Fields accepts.
  std::vector<std::string> output_field_names();

  /// Unit of a field's values, without brackets; empty: each of them has its own.
  std::string output_field_unit(const std::string &name);

  /// Whether one of the fields is made from the strain of the nodes.
  bool needs_strain(const std::vector<std::string> &names);

  /// Adds the named fields to the next output; solutions of a comparison that
  /// the scene does not make are left out.
  template <int dim>
  void add_output_fields(const Problem<dim>             &problem,
                         const std::vector<std::string> &names,
                         FieldSink<dim>                 &output);
} // namespace perideal

#endif
