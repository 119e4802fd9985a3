// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_precrack_h
#define perideal_neighbourhood_precrack_h

#include <perideal/geometry/facets.h>
#include <perideal/mesh/mesh.h>

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
    /// In their place a physical curve (2-D) or surface (3-D) inside the mesh.
    std::string boundary = "";
  };

  /// Section "Precracks".
  struct PrecrackParameters
  {
    std::vector<PrecrackText> cracks;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };

  /**
   * Cuts bonds along a crack that exists from the beginning: in 2-D a line through points, in 3-D a plane
   * polygon, or the faces of a group inside the mesh. Bonds that it crosses are cut, those through its tip or
   * edge included.
   */
  template <int dim>
  class Precrack
  {
  public:
    /// @throws InputError on text that is no such line, polygon or group.
    Precrack(const PrecrackText &text, const Mesh<dim> &mesh);

    /// Whether the bond between two points crosses the crack.
    bool crosses(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const
    {
      return facets.are_crossed(a, b);
    }

    /// What it consists of: segments in 2-D, polygons in 3-D.
    const std::vector<Facet<dim>> &parts() const { return facets.all(); }

  private:
    Facets<dim> facets;
  };
} // namespace perideal

#endif
