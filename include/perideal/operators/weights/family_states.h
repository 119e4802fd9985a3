// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_family_states_h
#define perideal_operators_weights_family_states_h

#include <perideal/operators/weights/family_weights.h>

#include <array>
#include <vector>

namespace perideal
{
  /// Turns the sums of owned nodes into states, and fetches those of ghosts from their owners. Collective.
  /// @param sums, state by local node @param ghosted work space, n_sums values a node with ghosts; as the
  /// last call has left it where nodes are left out
  /// @param visit_nodes calls its argument with the owned nodes: those left out keep their states
  template <unsigned int n_sums, typename VisitNodes>
  void turn_sums_into_states(const FamilyMaps<n_sums>                      &map,
                             const std::array<std::vector<double>, n_sums> &sums,
                             std::array<std::vector<double>, n_sums>       &state,
                             NodalVector                                   &ghosted,
                             const VisitNodes                              &visit_nodes)
  {
    const LocalIndex n_local = map.entries.size(), n_owned = ghosted.locally_owned_size() / n_sums;
    const bool       has_ghosts = n_local > n_owned;
    visit_nodes([&](const LocalIndex i) {
      std::array<double, n_sums> s;
      for (unsigned int a = 0; a < n_sums; ++a)
        s[a] = sums[a][i];
      s = map.states(i, s);
      for (unsigned int a = 0; a < n_sums; ++a)
        {
          state[a][i] = s[a];
          if (has_ghosts)
            ghosted.local_element(n_sums * i + a) = s[a];
        }
    });
    if (!has_ghosts)
      return;
    ghosted.update_ghost_values();
    for (LocalIndex i = n_owned; i < n_local; ++i)
      for (unsigned int a = 0; a < n_sums; ++a)
        state[a][i] = ghosted.local_element(n_sums * i + a);
    ghosted.zero_out_ghost_values();
  }

  template <unsigned int n_sums>
  void turn_sums_into_states(const FamilyMaps<n_sums>                      &map,
                             const std::array<std::vector<double>, n_sums> &sums,
                             std::array<std::vector<double>, n_sums>       &state,
                             NodalVector                                   &ghosted)
  {
    turn_sums_into_states<n_sums>(map, sums, state, ghosted, [&](const auto &visit) {
      for (LocalIndex i = 0; i < ghosted.locally_owned_size() / n_sums; ++i)
        visit(i);
    });
  }
} // namespace perideal

#endif
