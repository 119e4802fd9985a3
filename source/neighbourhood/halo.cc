// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/halo.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace perideal
{
  namespace
  {
    /// Boxes travel as plain numbers: lower, upper, reach, horizon.
    template <int dim>
    std::vector<std::vector<HorizonBox<dim>>> gather_boxes(const std::vector<HorizonBox<dim>> &mine,
                                                           MPI_Comm                            communicator)
    {
      std::vector<double> flat;
      for (const auto &box : mine)
        {
          for (int d = 0; d < dim; ++d)
            flat.insert(flat.end(), {box.lower[d], box.upper[d], box.reach[d]});
          flat.push_back(box.horizon);
        }
      std::vector<std::vector<HorizonBox<dim>>> result;
      for (const auto &numbers : dealii::Utilities::MPI::all_gather(communicator, flat))
        {
          result.emplace_back(numbers.size() / (3 * dim + 1));
          const double *number = numbers.data();
          for (auto &box : result.back())
            {
              for (int d = 0; d < dim; ++d)
                {
                  box.lower[d] = *number++;
                  box.upper[d] = *number++;
                  box.reach[d] = *number++;
                }
              box.horizon = *number++;
            }
        }
      return result;
    }

    template <typename T>
    void append_bytes(const T &value, std::vector<char> &bytes)
    {
      const auto begin = reinterpret_cast<const char *>(&value);
      bytes.insert(bytes.end(), begin, begin + sizeof(T));
    }

    /// Appends what the bytes say; returns where they end.
    template <typename T>
    const char *read_bytes(const char *bytes, std::vector<T> &values)
    {
      values.emplace_back();
      std::copy(bytes, bytes + sizeof(T), reinterpret_cast<char *>(&values.back()));
      return bytes + sizeof(T);
    }
  } // namespace

  template <int dim>
  Halo<dim> exchange_halo(const NodeCloud<dim> &nodes, const PointTree<dim> &tree)
  {
    const MPI_Comm     communicator = nodes.communicator;
    const unsigned int me           = dealii::Utilities::MPI::this_mpi_process(communicator);
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return {};

    const auto boxes = gather_boxes(tree.cover(64), communicator);

    // Nodes are trivially copyable; they travel as bytes.
    using Bytes = std::vector<char>;
    std::map<unsigned int, Bytes> outbox;
    std::vector<LocalIndex>       leaves;
    std::vector<bool>             chosen(nodes.size());
    for (unsigned int rank = 0; rank < boxes.size(); ++rank)
      {
        if (rank == me)
          continue;
        std::fill(chosen.begin(), chosen.end(), false);
        for (const auto &box : boxes[rank])
          {
            tree.find_leaves(box, leaves);
            for (const LocalIndex leaf : leaves)
              for (LocalIndex i = tree.leaf_begin(leaf); i < tree.leaf_end(leaf); ++i)
                if (box.may_interact(HorizonBox<dim>::of(nodes.position[i], nodes.reach(i))))
                  chosen[i] = true;
          }
        Bytes message;
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          if (chosen[i])
            {
              append_bytes(HaloNode<dim>{nodes.first_global + i,
                                         me,
                                         nodes.position[i],
                                         nodes.volume[i],
                                         nodes.horizon[i],
                                         nodes.spacing[i],
                                         nodes.finest_share(i),
                                         nodes.material[i],
                                         nodes.cell_radius.empty() ? 0. : nodes.cell_radius[i],
                                         nodes.shape.empty() ? dealii::Tensor<2, dim>() : nodes.shape[i],
                                         nodes.reach(i)},
                           message);
              if (nodes.has_cells)
                append_bytes(nodes.cell[i], message);
            }
        if (!message.empty())
          outbox[rank] = std::move(message);
      }

    Halo<dim> result;
    for (const auto &inbox : dealii::Utilities::MPI::some_to_some(communicator, outbox))
      for (const char *at = inbox.second.data(); at != inbox.second.data() + inbox.second.size();)
        {
          at = read_bytes(at, result.nodes);
          if (nodes.has_cells)
            at = read_bytes(at, result.cells);
        }
    // Messages come by ascending rank and so by ascending global number.
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(HaloNode)
  PERIDEAL_INSTANTIATE(exchange_halo)
} // namespace perideal
