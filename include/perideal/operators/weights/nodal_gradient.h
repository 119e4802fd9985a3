// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_nodal_gradient_h
#define perideal_operators_weights_nodal_gradient_h

#include <perideal/reconstruction/face_gradient.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace perideal
{
  /// The face gradient at work on vectors of nodal values, in the layout of its graph.
  template <int dim>
  class NodalGradient
  {
  public:
    /// Collective.
    explicit NodalGradient(const std::shared_ptr<const FaceGradient<dim>> &gradient)
      : gradient(gradient)
      , partitioner(gradient->graph().make_partitioner(dim))
      , ghosted(partitioner)
    {
      const CellGraph<dim> &graph = gradient->graph();
      for (LocalIndex i = 0; i < graph.n_local(); ++i)
        place.push_back(partitioner->global_to_local(dim * graph.global_number(i)) / dim);
    }

    /// Takes the displacement of owned nodes, of ghosts from their owners. Collective.
    void read(const NodalVector &displacement) const
    {
      ghosted.zero_out_ghost_values();
      std::copy(displacement.begin(), displacement.begin() + dim * rows().n_rows(), ghosted.begin());
      ghosted.update_ghost_values();
    }

    /// Gradient d u_k/d x_l at an owned node, of the displacement read [-].
    dealii::Tensor<2, dim> at(const LocalIndex i) const
    {
      dealii::Tensor<2, dim> result;
      for (BondIndex m = rows().first[i]; m < rows().first[i + 1]; ++m)
        for (int k = 0; k < dim; ++k)
          result[k] += ghosted.local_element(dim * place_of(m) + k) * rows().value[m];
      return result;
    }

    const StencilRows<dealii::Tensor<1, dim>> &rows() const { return gradient->rows(); }

    /// Where vectors have the values of the node of a row's entry, over dim.
    LocalIndex place_of(const BondIndex m) const { return place[rows().column[m]]; }

    /// Global number of that node.
    GlobalIndex global_number(const BondIndex m) const
    {
      return gradient->graph().global_number(rows().column[m]);
    }

    const FaceGradient<dim> &of_faces() const { return *gradient; }

    /// Layout of vectors whose ghosts are those of the graph.
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout() const { return partitioner; }

    std::size_t memory_consumption() const
    {
      return gradient->memory_consumption() + place.size() * sizeof(LocalIndex) +
             ghosted.memory_consumption();
    }

  private:
    std::shared_ptr<const FaceGradient<dim>>                   gradient;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::vector<LocalIndex>                                    place;
    mutable NodalVector                                        ghosted;
  };
} // namespace perideal

#endif
