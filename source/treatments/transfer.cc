// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/boundary/transfer_functions.h>
#include <perideal/treatments/treatments.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

/*
 * Treatment "transfer" of tractions: the transfer function G of PDBC (3.16) without its factor and without L,
 * such that the nodes carry force F and moment M of every face exactly:
 *
 *     f_i = q_ik V_i [ F / Q_k + omega x (x_i - c_k) ],
 *     omega = I_k^-1 ( M - (c_k - x_k) x F ),   I_k = sum_i q_ik V_i ( |r_i|^2 1 - r_i r_i^T ),
 *
 * with the centroid c_k of the nodes, weighted by q_ik V_i, and r_i = x_i - c_k. F and M, about the centroid
 * x_k of the face, are integrals over it. For a uniform traction along the normal of a straight side away
 * from corners omega is zero. Nodes along a line carry no moment about it: there the inverse is the
 * pseudo-inverse.
 */
namespace perideal
{
  namespace
  {
    using Matrix = dealii::SymmetricTensor<2, 3>;

    template <int dim>
    class BalancedTransfer : public Tractions<dim>
    {
    public:
      BalancedTransfer(const TreatedBody<dim> &body, const TreatedBonds<dim> &bonds)
        : Tractions<dim>(body, bonds)
        , functions(body.nodes, gather_faces(body.faces, body.nodes.communicator))
      {
        const auto moments = sum_moments();
        for (std::size_t k = 0; k < functions.faces().size(); ++k)
          carriers.push_back(make_carriers(functions.node_sums()[k], &moments[n_moments * k]));
      }

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        const auto &faces = functions.faces();
        visit_loaded_faces(
          given, faces, [&](const BoundaryCondition<dim> &condition, const SurfaceFace<dim> &face) {
            const std::size_t k = &face - faces.data();
            if (functions.entries()[k].empty())
              return;
            const auto load = integrate_traction<dim>(condition, face, time, face.centre);
            const auto pull = load.force / functions.node_sums()[k];
            const auto left =
              load.moment - dealii::cross_product_3d(carriers[k].centroid, in_space(load.force));
            const auto turn = carriers[k].inverse_inertia * left;
            for (const auto &[i, q] : functions.entries()[k])
              {
                const auto arm = in_space<dim>(functions.positions()[i] - face.centre) - carriers[k].centroid;
                const auto turned = dealii::cross_product_3d(turn, arm);
                for (int d = 0; d < dim; ++d)
                  force.local_element(dim * i + d) += q * functions.volumes()[i] * (pull[d] + turned[d]);
              }
          });
      }

      std::string describe() const override { return ", tractions by transfer"; }

    private:
      /// First and second moments about the centroid of a face.
      static constexpr unsigned int n_moments = 3 + Matrix::n_independent_components;

      /// Of the nodes of a face: their centroid, from that of the face [m], and the inverse of I [1/m^5].
      struct Carriers
      {
        dealii::Tensor<1, 3> centroid;
        dealii::Tensor<2, 3> inverse_inertia;
      };

      /// Those of the nodes of all ranks, face by face. Collective.
      std::vector<double> sum_moments() const
      {
        const auto         &faces = functions.faces();
        std::vector<double> moments(n_moments * faces.size(), 0.);
        for (std::size_t k = 0; k < faces.size(); ++k)
          for (const auto &[i, q] : functions.entries()[k])
            {
              const double weight = q * functions.volumes()[i];
              const auto   arm    = in_space<dim>(functions.positions()[i] - faces[k].centre);
              for (unsigned int d = 0; d < 3; ++d)
                moments[n_moments * k + d] += weight * arm[d];
              for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
                {
                  const auto rows = Matrix::unrolled_to_component_indices(m);
                  moments[n_moments * k + 3 + m] += weight * arm[rows[0]] * arm[rows[1]];
                }
            }
        dealii::Utilities::MPI::sum(moments, functions.communicator(), moments);
        return moments;
      }

      /// @param total Q of the face @param moments its own
      static Carriers make_carriers(const double total, const double *moments)
      {
        Carriers result;
        for (unsigned int d = 0; d < 3; ++d)
          result.centroid[d] = moments[d] / total;
        Matrix spread;
        for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
          spread[Matrix::unrolled_to_component_indices(m)] = moments[3 + m];
        const double scale = trace(spread);
        for (unsigned int m = 0; m < Matrix::n_independent_components; ++m)
          {
            const auto rows = Matrix::unrolled_to_component_indices(m);
            spread[rows] -= total * result.centroid[rows[0]] * result.centroid[rows[1]];
          }
        result.inverse_inertia =
          pseudo_inverse(trace(spread) * dealii::unit_symmetric_tensor<3>() - spread, 1e-10 * scale);
        return result;
      }

      const TransferFunctions<dim> functions;
      std::vector<Carriers>        carriers;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_transfer(const TreatedBody<dim>  &body,
                                                   const TreatedBonds<dim> &bonds)
  {
    const Timings::Scope part(body.timings, "setup: transfer functions");
    return std::make_unique<BalancedTransfer<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(load_by_transfer)
} // namespace perideal
