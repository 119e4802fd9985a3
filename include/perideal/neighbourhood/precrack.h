// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_precrack_h
#define perideal_neighbourhood_precrack_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// One subsection of "Precracks", as text.
  struct PrecrackText
  {
    std::string name;
    /// Points separated by semicolons, coordinates [m] by commas.
    std::string points;
  };

  /// Section "Precracks".
  struct PrecrackParameters
  {
    std::vector<PrecrackText> cracks;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };

  /**
   * A crack that is there from the beginning: in 2-D a line through points, in 3-D a plane
   * polygon. Bonds that it crosses are cut, those through its tip or edge included.
   */
  template <int dim>
  class Precrack
  {
  public:
    /// @throws InputError on text that is no such line or polygon.
    explicit Precrack(const PrecrackText &text);

    /// Whether the bond between two points crosses the crack.
    bool crosses(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const;

  private:
    std::vector<dealii::Point<dim>> points;
    /// Unit normal of the polygon, and its size [m], in 3-D.
    dealii::Tensor<1, dim> normal;
    double                 size = 0;
  };
} // namespace perideal

#endif
