// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_record_exchange_h
#define perideal_base_record_exchange_h

#include <perideal/base/lanes.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/array_view.h>
#include <deal.II/base/partitioner.h>

#include <vector>

namespace perideal
{
  /// Copies numbers to the ranks that have them as ghosts, without a vector of their own: those of ghosts
  /// stand behind the layout's owned ones. Collective.
  inline void update_ghosts(const dealii::Utilities::MPI::Partitioner &layout,
                            double *const                              all,
                            std::vector<double>                       &buffer)
  {
    const unsigned int n = layout.locally_owned_size();
    buffer.resize(layout.n_import_indices());
    std::vector<MPI_Request> requests;
    layout.export_to_ghosted_array_start<double>(0,
                                                 dealii::ArrayView<const double>(all, n),
                                                 dealii::ArrayView<double>(buffer.data(), buffer.size()),
                                                 dealii::ArrayView<double>(all + n, layout.n_ghost_indices()),
                                                 requests);
    layout.export_to_ghosted_array_finish<double>(
      dealii::ArrayView<double>(all + n, layout.n_ghost_indices()), requests);
  }

  /// The same with records of nodes.
  /// @param layout of four numbers a record
  inline void update_ghosts(const dealii::Utilities::MPI::Partitioner &layout,
                            dealii::AlignedVector<NodeRecord>         &records,
                            std::vector<double>                       &buffer)
  {
    update_ghosts(layout, records.data()->value, buffer);
  }

  /// Adds the records of ghosts to those of their owners. Collective.
  inline void add_to_owners(const dealii::Utilities::MPI::Partitioner &layout,
                            dealii::AlignedVector<NodeRecord>         &records,
                            std::vector<double>                       &buffer)
  {
    const unsigned int n   = layout.locally_owned_size();
    double            *all = records.data()->value;
    buffer.resize(layout.n_import_indices());
    std::vector<MPI_Request>  requests;
    dealii::ArrayView<double> ghosts(all + n, layout.n_ghost_indices());
    layout.import_from_ghosted_array_start<double>(dealii::VectorOperation::add,
                                                   1,
                                                   ghosts,
                                                   dealii::ArrayView<double>(buffer.data(), buffer.size()),
                                                   requests);
    layout.import_from_ghosted_array_finish<double>(
      dealii::VectorOperation::add,
      dealii::ArrayView<const double>(buffer.data(), buffer.size()),
      dealii::ArrayView<double>(all, n),
      ghosts,
      requests);
  }
} // namespace perideal

#endif
