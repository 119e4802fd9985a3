// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_equal_records_h
#define perideal_base_equal_records_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace perideal
{
  /// What coordinates of equal cells, seen from one of their points, differ by through rounding [m].
  template <int dim>
  double coordinate_rounding(const std::vector<dealii::Point<dim>> &points)
  {
    double largest = 0;
    for (const auto &point : points)
      for (int d = 0; d < dim; ++d)
        largest = std::max(largest, std::abs(point[d]));
    // Centroids are sums over the vertices and quadrature points of cells.
    return 64. * std::numeric_limits<double>::epsilon() * largest;
  }

  /**
   * Recognises records of numbers that are equal but for rounding to one that was seen before, and keeps
   * where the owner put what belongs to them. On structured meshes what describes a cell or a face is the
   * same for all inside the body, and there are few others near its surface; on others it gives up soon.
   */
  class EqualRecords
  {
  public:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /// A number and by how much equal ones differ at most, which is positive.
    struct Entry
    {
      double value, tolerance;
    };

    /// A number of something, of which each is on a line of its own of the lattice that values are looked up
    /// on.
    static Entry exactly(const std::size_t number) { return {static_cast<double>(number), 1e-7}; }

    /// @param looks whether records are looked for at all
    explicit EqualRecords(const bool looks)
      : looks(looks)
    {
    }

    /// Whether records are still looked for: not once hardly any of a good many was equal to another.
    bool is_looking() const { return looks; }

    /// The place of this record and its equals, for the caller to read and to set: none, as long as nobody
    /// set it. While is_looking().
    std::size_t &place_of(const std::vector<Entry> &record);

  private:
    std::size_t number_of(const std::vector<Entry> &record);
    bool        is_equal(const std::size_t number, const std::vector<Entry> &record) const;

    bool looks;
    /// Where the values of each begin, by number, and these.
    std::vector<std::size_t>                                    known;
    std::vector<double>                                         values;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> with_key;
    std::size_t                                                 n_seen = 0, last = 0;
    std::vector<std::size_t>                                    places;
  };
} // namespace perideal

#endif
