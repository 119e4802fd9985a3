// SPDX-License-Identifier: LGPL-2.1-or-later
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
  } // namespace

  template <int dim>
  std::vector<HaloNode<dim>> exchange_halo(const NodeCloud<dim> &nodes, const PointTree<dim> &tree)
  {
    const MPI_Comm     communicator = nodes.communicator;
    const unsigned int me           = dealii::Utilities::MPI::this_mpi_process(communicator);
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return {};

    const auto boxes = gather_boxes(tree.cover(64), communicator);

    // HaloNode is trivially copyable; it travels as bytes.
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
              const HaloNode<dim> node  = {nodes.first_global + i,
                                           me,
                                           nodes.position[i],
                                           nodes.volume[i],
                                           nodes.horizon[i],
                                           nodes.material[i],
                                          nodes.margin > 0 ? nodes.spacing[i] : 0.,
                                          nodes.shape.empty() ? dealii::Tensor<2, dim>() : nodes.shape[i],
                                           nodes.reach(i)};
              const auto          begin = reinterpret_cast<const char *>(&node);
              message.insert(message.end(), begin, begin + sizeof(node));
            }
        if (!message.empty())
          outbox[rank] = std::move(message);
      }

    std::vector<HaloNode<dim>> result;
    for (const auto &inbox : dealii::Utilities::MPI::some_to_some(communicator, outbox))
      {
        const std::size_t first = result.size();
        result.resize(first + inbox.second.size() / sizeof(HaloNode<dim>));
        std::copy(inbox.second.begin(), inbox.second.end(), reinterpret_cast<char *>(result.data() + first));
      }
    // Messages come by ascending rank and so by ascending global number.
    return result;
  }

  template struct HaloNode<2>;
  template struct HaloNode<3>;
  template std::vector<HaloNode<2>> exchange_halo(const NodeCloud<2> &, const PointTree<2> &);
  template std::vector<HaloNode<3>> exchange_halo(const NodeCloud<3> &, const PointTree<3> &);
} // namespace perideal
