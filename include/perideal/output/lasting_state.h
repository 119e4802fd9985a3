// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_lasting_state_h
#define perideal_output_lasting_state_h

#include <perideal/output/checkpoint.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * The one list of what lasts from step to step: damage, broken bonds, the memory of materials, the state of
   * solvers. Whoever has such registers it here once, by name, unit and numbers a node or bond; checkpoints,
   * runs that go on (on any number of ranks) and fields take it from here. What is registered must outlive
   * this object.
   *
   * resume() sets in the order of registration: what others need comes first.
   */
  class LastingState
  {
  public:
    using Json    = nlohmann::ordered_json;
    using Numbers = std::vector<double>;

    /// Whether Output/Fields = state shows an array.
    enum class Show
    {
      never,
      as_field
    };

    /// Registers an array of @p width numbers for each owned node, one node after another; where there are
    /// fewer, they are those of the first nodes.
    void add_node_array(const std::string                          &name,
                        const std::string                          &unit,
                        const unsigned int                          width,
                        const std::function<Numbers()>             &get,
                        const std::function<void(const Numbers &)> &set,
                        const Show                                  show     = Show::never,
                        const Transfer                              transfer = Transfer::constant);

    /// The same in a vector of owned components, the size of which stays; a field that is smooth.
    template <typename Vector>
    void add_node_array(const std::string &name,
                        const std::string &unit,
                        const unsigned int width,
                        Vector            &values,
                        const Show         show = Show::never)
    {
      add_node_array(
        name,
        unit,
        width,
        [&values] { return Numbers(values.begin(), values.end()); },
        [&values](const Numbers &read) {
          const std::size_t size = std::distance(values.begin(), values.end());
          std::copy_n(read.begin(), std::min(size, read.size()), values.begin());
        },
        show,
        Transfer::smooth);
    }

    /// Registers an array over some bonds, in an order that stays on the same number of ranks. Ranks that
    /// share a bond both have it; a rank may get it twice.
    void add_bond_array(const std::string                            &name,
                        const std::string                            &unit,
                        const unsigned int                            width,
                        const std::function<BondArray()>             &get,
                        const std::function<void(const BondArray &)> &set);

    /// Registers what all ranks agree on.
    void add_value(const std::string                       &name,
                   const std::function<Json()>             &get,
                   const std::function<void(const Json &)> &set);

    template <typename T>
    void add_value(const std::string &name, T &value)
    {
      add_value(
        name, [&value] { return Json(value); }, [&value](const Json &read) { value = read.get<T>(); });
    }

    /// Registers the part of a tree that has this name, as soon as there is one.
    void add_part(const std::string &name, Json &tree);

    /// Registers a number of this rank, the sum of which over the ranks counts.
    void add_sum(const std::string &name, double &share);

    void save(Checkpoint &checkpoint) const;

    /// @throws InputError when something is not in the checkpoint, or of another kind.
    void resume(const Checkpoint &checkpoint) const;

    /// A node array that may be shown.
    struct Field
    {
      std::string              name, unit;
      unsigned int             width;
      std::function<Numbers()> get;
    };
    const std::vector<Field> &fields() const { return shown; }

  private:
    struct Item
    {
      std::function<void(Checkpoint &)>       save;
      std::function<void(const Checkpoint &)> resume;
    };

    void add(const std::string &name, const Item &item);

    std::vector<Item>     items;
    std::set<std::string> names;
    std::vector<Field>    shown;
  };
} // namespace perideal

#endif
