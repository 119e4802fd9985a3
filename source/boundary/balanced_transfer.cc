// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/boundary/balanced_transfer.h>
#include <perideal/boundary/face_tractions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

namespace perideal
{
  namespace
  {
    using Matrix = dealii::SymmetricTensor<2, 3>;
  } // namespace

  template <int dim>
  BalancedTransfer<dim>::BalancedTransfer(TransferFunctions<dim> functions)
    : functions(std::move(functions))
  {
    const auto &faces = this->functions.faces();
    // First and second moments of the nodes about the centroid of the face.
    constexpr unsigned int size = 3 + Matrix::n_independent_components;
    std::vector<double>    moments(size * faces.size(), 0.);
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (const auto &[i, q] : this->functions.entries()[k])
        {
          const double weight = q * this->functions.volumes()[i];
          const auto   arm    = in_space<dim>(this->functions.positions()[i] - faces[k].centre);
          for (unsigned int d = 0; d < 3; ++d)
            moments[size * k + d] += weight * arm[d];
          for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
            {
              const auto rows = Matrix::unrolled_to_component_indices(m);
              moments[size * k + 3 + m] += weight * arm[rows[0]] * arm[rows[1]];
            }
        }
    dealii::Utilities::MPI::sum(moments, this->functions.communicator(), moments);

    for (std::size_t k = 0; k < faces.size(); ++k)
      {
        const double total = this->functions.node_sums()[k];
        Carriers     result;
        for (unsigned int d = 0; d < 3; ++d)
          result.centroid[d] = moments[size * k + d] / total;
        Matrix spread;
        for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
          spread[Matrix::unrolled_to_component_indices(m)] = moments[size * k + 3 + m];
        const double scale = trace(spread);
        for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
          {
            const auto rows = Matrix::unrolled_to_component_indices(m);
            spread[rows] -= total * result.centroid[rows[0]] * result.centroid[rows[1]];
          }
        result.inverse_inertia =
          pseudo_inverse(trace(spread) * dealii::unit_symmetric_tensor<3>() - spread, 1e-10 * scale);
        carriers.push_back(result);
      }
  }

  template <int dim>
  void
  BalancedTransfer<dim>::add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    const auto &faces = functions.faces();
    visit_loaded_faces(
      loads, faces, [&](const BoundaryCondition<dim> &condition, const SurfaceFace<dim> &face) {
        const std::size_t k = &face - faces.data();
        if (functions.entries()[k].empty())
          return;
        const auto load = integrate_traction<dim>(condition, face, time, face.centre);
        const auto pull = load.force / functions.node_sums()[k];
        const auto left = load.moment - dealii::cross_product_3d(carriers[k].centroid, in_space(load.force));
        const auto turn = carriers[k].inverse_inertia * left;
        for (const auto &[i, q] : functions.entries()[k])
          {
            const auto arm    = in_space<dim>(functions.positions()[i] - face.centre) - carriers[k].centroid;
            const auto turned = dealii::cross_product_3d(turn, arm);
            for (int d = 0; d < dim; ++d)
              force.local_element(dim * i + d) += q * functions.volumes()[i] * (pull[d] + turned[d]);
          }
      });
  }

  PERIDEAL_INSTANTIATE_CLASS(BalancedTransfer)
} // namespace perideal
