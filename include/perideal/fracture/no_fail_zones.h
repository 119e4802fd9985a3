// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_no_fail_zones_h
#define perideal_fracture_no_fail_zones_h

#include <perideal/geometry/facets.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// One subsection of "No-fail zones", as text.
  struct NoFailZoneText
  {
    std::string name;
    /// Physical name or id of a boundary, and how far from its faces nodes are in the zone [m].
    std::string boundary;
    double      distance = 0;
    /// Lower and upper corner, separated by a semicolon, coordinates [m] by commas.
    std::string box;
  };

  /// Section "No-fail zones".
  struct NoFailParameters
  {
    std::vector<NoFailZoneText> zones;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };

  /**
   * Protects zones in which nothing breaks, as at loads and supports: bonds with an end in one of the zones
   * are unbreakable. A zone holds the positions near a boundary or in a box; where it has both, those that
   * meet both.
   */
  template <int dim>
  class NoFailZones
  {
  public:
    /// Gathers the faces of boundaries that zones name. Collective.
    /// @throws InputError on zones of nothing, on text that is no box, on unknown boundaries.
    NoFailZones(const NoFailParameters &parameters, const Mesh<dim> &mesh);

    bool empty() const { return zones.empty(); }

    bool contains(const dealii::Point<dim> &position) const;

    /// Nodes of all ranks in the zones. Collective.
    /// @throws InputError on a zone without nodes.
    GlobalIndex count(const NodeCloud<dim> &nodes) const;

  private:
    struct Zone
    {
      std::string                             name;
      std::optional<Facets<dim>>              faces;
      double                                  distance;
      std::optional<dealii::BoundingBox<dim>> box;

      bool contains(const dealii::Point<dim> &position) const;
    };

    std::vector<Zone> zones;
  };
} // namespace perideal

#endif
