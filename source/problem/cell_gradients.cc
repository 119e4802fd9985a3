// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/nodal_strain.h>
#include <perideal/materials/models.h>
#include <perideal/problem/cell_gradients.h>
#include <perideal/problem/discrete_body.h>

namespace perideal
{
  template <int dim>
  void CellGradients<dim>::make(const Body<dim> &body, const BondPredicate<dim> &is_cut)
  {
    if (*this)
      return;
    const auto stiffness = [&](const dealii::types::material_id id) {
      return body.solids.at(id).isotropic().shear_modulus();
    };
    const ModelParameters &model = body.parameters.model;
    if (!model.is_consistent())
      {
        linear = std::make_shared<const FaceGradient<dim>>(*body.mesh, *body.nodes, stiffness);
        return;
      }
    const bool share_equal = body.parameters.nodes.share_equal_families;
    // Polynomials are closed by the directions of the body at rest, which large rotations leave.
    const auto                               solid_of = solids_of_model(body);
    typename CellPolynomials<dim>::Stiffness of_closure;
    const bool                               moves = body.parameters.solver.is_dynamic();
    if (model.law->is_linear && !moves)
      of_closure = [&](const dealii::types::material_id id) { return solid_of(id).stiffness(); };
    polynomials = std::make_shared<const CellPolynomials<dim>>(*body.mesh,
                                                               *body.nodes,
                                                               of_closure,
                                                               is_cut,
                                                               moves ? CellUnknown::value : CellUnknown::mean,
                                                               share_equal);
    faces =
      std::make_shared<const FaceMoments<dim>>(*body.mesh, *polynomials, stiffness, is_cut, share_equal);
  }

  template <int dim>
  void CellGradients<dim>::make_moments(const Body<dim>                              &body,
                                        const std::shared_ptr<const FaceValues<dim>> &prescribed)
  {
    moments =
      std::make_shared<const GradientMoments<dim>>(polynomials, faces, prescribed, body.nodes->communicator);
  }

  template <int dim>
  const std::vector<BoundaryPoint<dim>> &CellGradients<dim>::boundary_points() const
  {
    return faces ? faces->boundary_points() : linear->boundary_points();
  }

  template <int dim>
  const CellGraph<dim> *CellGradients<dim>::graph() const
  {
    return polynomials ? &polynomials->graph() : linear ? &linear->graph() : nullptr;
  }

  template <int dim>
  const std::vector<bool> &CellGradients<dim>::deficient() const
  {
    return polynomials ? polynomials->deficient() : linear->deficient();
  }

  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>>
  CellGradients<dim>::mean_strains(const Nodes<dim>                          &nodes,
                                   const FaceValues<dim>                     &prescribed,
                                   const NodalVector                         &unknowns,
                                   const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    if (linear)
      return compute_nodal_strain(*linear, prescribed, nodes, displacement);
    moments->read(unknowns, GradientMoments<dim>::AtFaces::values);
    std::vector<dealii::SymmetricTensor<2, dim>> result(nodes.size());
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
          result[i][a][b] = 0.5 * (moments->gradient(i)[b].value[a] + moments->gradient(i)[a].value[b]);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(CellGradients)
} // namespace perideal
