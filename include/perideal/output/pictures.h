// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_pictures_h
#define perideal_output_pictures_h

#include <perideal/base/python_tool.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace perideal
{
  /// What section "Output" says of pictures.
  struct PictureParameters
  {
    /// Fields to draw at the end of a run, separated by commas; empty: none.
    std::string fields;
    /// Where a three-dimensional body is seen from: a direction x, y, z.
    std::vector<double> view = {1., -2., 1.};
    /// Whether to write report.html.
    bool report = false;

    void declare(dealii::ParameterHandler &prm);

    /// @throws InputError on a view from nowhere.
    void check() const;

    /// The fields by name, in the order given.
    std::vector<std::string> field_names() const;

    /// Whether anything is to be drawn.
    bool are_wanted() const { return report || !field_names().empty(); }
  };

  /**
   * Draws the last fields and the curves of the run in a directory, and writes its report where that is asked
   * for, by the script plot.py. One rank calls it. Throws nothing: a run does not fail for want of a picture.
   *
   * @return the names of the files, or why there are none
   */
  ToolResult draw_pictures(const std::string &directory, const PictureParameters &parameters);
} // namespace perideal

#endif
