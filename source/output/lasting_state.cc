// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/lasting_state.h>

#include <deal.II/base/exceptions.h>

namespace perideal
{
  namespace
  {
    /// The array of that name. @throws InputError when there is none, or one of another width.
    template <typename Array>
    const Array &
    find(const std::map<std::string, Array> &arrays, const std::string &name, const unsigned int width)
    {
      const auto found = arrays.find(name);
      if (found == arrays.end() || found->second.width != width)
        throw Checkpoint::lacks(name);
      return found->second;
    }
  } // namespace

  void LastingState::add(const std::string &name, const Item &item)
  {
    AssertThrow(names.insert(name).second, dealii::ExcMessage("'" + name + "' is registered twice"));
    items.push_back(item);
  }

  void LastingState::add_node_array(const std::string                          &name,
                                    const std::string                          &unit,
                                    const unsigned int                          width,
                                    const std::function<Numbers()>             &get,
                                    const std::function<void(const Numbers &)> &set,
                                    const Show                                  show,
                                    const Transfer                              transfer)
  {
    add(name,
        {[=](Checkpoint &checkpoint) {
           checkpoint.node_arrays[name] = {unit, width, get(), transfer};
         },
         [=](const Checkpoint &checkpoint) { set(find(checkpoint.node_arrays, name, width).values); }});
    if (show == Show::as_field)
      shown.push_back({name, unit, width, get});
  }

  void LastingState::add_bond_array(const std::string                            &name,
                                    const std::string                            &unit,
                                    const unsigned int                            width,
                                    const std::function<BondArray()>             &get,
                                    const std::function<void(const BondArray &)> &set)
  {
    add(name,
        {[=](Checkpoint &checkpoint) {
           BondArray array = get();
           AssertDimension(array.values.size(), width * array.bonds.size());
           checkpoint.bond_arrays[name] = {unit, width, std::move(array.bonds), std::move(array.values)};
         },
         [=](const Checkpoint &checkpoint) { set(find(checkpoint.bond_arrays, name, width)); }});
  }

  void LastingState::add_value(const std::string                       &name,
                               const std::function<Json()>             &get,
                               const std::function<void(const Json &)> &set)
  {
    add(name,
        {[=](Checkpoint &checkpoint) { checkpoint.header[name] = get(); },
         [=](const Checkpoint &checkpoint) {
           try
             {
               set(checkpoint.header.at(name));
             }
           catch (const Json::exception &)
             {
               throw Checkpoint::lacks(name);
             }
         }});
  }

  void LastingState::add_part(const std::string &name, Json &tree)
  {
    add_value(
      name,
      [name, &tree] { return tree.value(name, Json()); },
      [name, &tree](const Json &read) {
        if (!read.is_null())
          tree[name] = read;
      });
  }

  void LastingState::add_sum(const std::string &name, double &share)
  {
    add(name,
        {[&share, name](Checkpoint &checkpoint) { checkpoint.sums[name] = {share}; },
         [&share, name](const Checkpoint &checkpoint) {
           const auto found = checkpoint.sums.find(name);
           if (found == checkpoint.sums.end() || found->second.size() != 1)
             throw Checkpoint::lacks(name);
           share = found->second[0];
         }});
  }

  void LastingState::save(Checkpoint &checkpoint) const
  {
    for (const Item &item : items)
      item.save(checkpoint);
  }

  void LastingState::resume(const Checkpoint &checkpoint) const
  {
    for (const Item &item : items)
      item.resume(checkpoint);
  }
} // namespace perideal
