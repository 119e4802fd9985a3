// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_crack_figures_h
#define perideal_recorders_crack_figures_h

#include <perideal/problem/crack_driving.h>
#include <perideal/recorders/make_recorders.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Tells of the cracks that a scene follows what drives them, how long they are, and what their growth
   * dissipated. Until a crack grows, its tip is that of the precrack within a horizon of its origin; from
   * then on the end of its last part, at which there is an energy release rate, but no stress intensity
   * factors: where the tip is between the nodes would decide them.
   */
  template <int dim>
  class CrackFigures
  {
  public:
    /// Problem and tracker must outlive this object. Collective.
    /// @throws InputError on a domain that leaves the body or holds too few cells.
    CrackFigures(const Problem<dim> &problem, const CrackTracker<dim> &tracker, const RunKind &kind);

    /// Computes the figures of a step, as of the last CrackTracker::collect(), and adds them to the history.
    /// Collective.
    void record(const Step<dim> &step, History &history);

    /**
     * Adds the figures of the last step to what is told of each crack, null what there is not:
     * energy_release_rate [J/m^2], K_I, K_II [Pa m^0.5], domain_radius [m], length [m]: that of the precrack
     * as drawn and what grew, new_length [m], dissipated_per_area [J/m^2], of all cracks together.
     */
    void describe(nlohmann::ordered_json &cracks) const;

    /// Returns what there is of them in words; empty: nothing.
    static std::string in_words(const nlohmann::ordered_json &crack);

  private:
    struct Crack
    {
      std::string        name;
      dealii::Point<dim> origin;
      /// Of plane precracks.
      std::optional<CrackEnd<dim>> tip;
      /// Of the precrack [m]; points along it.
      double                          initial_length = 0;
      std::vector<dealii::Point<dim>> drawn;
      double                          domain_radius = 0;

      /// Of the last step.
      double                    new_length = 0, radius = 0;
      std::optional<CrackDrive> drive;
    };

    /// Whether G is computed.
    bool integrates() const { return dim == 2 && driving != nullptr; }
    void find_precrack(Crack &crack) const;
    void check_radius(const Crack &crack) const;
    /// Collective.
    void integrate();
    /// The tip of a crack as it is now; none where none is known. Collective.
    std::optional<CrackDriving::Tip> tip_of(const std::size_t number) const;

    const Problem<dim>           &problem;
    const CrackTracker<dim>      &tracker;
    std::unique_ptr<CrackDriving> driving;
    std::vector<Crack>            cracks;
    /// [J/m^2]
    std::optional<double> dissipated_per_area;
  };
} // namespace perideal

#endif
