// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/missing_bonds.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Symmetric tensors in Kelvin's basis, in which contractions are scalar products: E_p.
    template <int dim>
    dealii::SymmetricTensor<2, dim> kelvin_tensor(const unsigned int p)
    {
      dealii::SymmetricTensor<2, dim> result;
      result.access_raw_entry(p) = p < dim ? 1. : std::sqrt(0.5);
      return result;
    }

    template <int dim>
    Eigen::Matrix<double, dim *(dim + 1) / 2, 1> kelvin_vector(const dealii::SymmetricTensor<2, dim> &tensor)
    {
      Eigen::Matrix<double, dim *(dim + 1) / 2, 1> result;
      for (unsigned int p = 0; p < tensor.n_independent_components; ++p)
        result[p] = (p < dim ? 1. : std::sqrt(2.)) * tensor.access_raw_entry(p);
      return result;
    }
  } // namespace

  template <int dim>
  MissingBonds<dim>::MissingBonds(const std::shared_ptr<const BondOperator<dim>>             &bonds,
                                  const std::shared_ptr<const FaceGradient<dim>>             &gradient,
                                  const std::vector<std::vector<SurfacePlane<dim>>>          &planes,
                                  const Loads<dim>                                           &loads,
                                  const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                                  const SolidOf<dim>                                         &solid_of)
    : bonds(bonds)
    , gradient(gradient)
  {
    this->counts  = bonds->counts;
    this->reports = bonds->reports;
    // Rows reach to the nodes of bonds and of gradients.
    NodalVector layout;
    bonds->initialize(layout);
    dealii::IndexSet ghosts = layout.get_partitioner()->ghost_indices();
    ghosts.add_indices(this->gradient.layout()->ghost_indices());
    const auto &graph = gradient->graph();
    this->partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      layout.locally_owned_elements(), ghosts, graph.communicator);

    const auto moments = find_moments();
    double     largest = 0;
    for (const Moment &moment : moments)
      largest = std::max(largest, moment.norm());
    largest = dealii::Utilities::MPI::max(largest, graph.communicator);

    using Stiffness = Eigen::Matrix<double, n_strains, n_strains>;
    std::map<dealii::types::material_id, Stiffness> stiffnesses;
    for (LocalIndex i = 0; i < moments.size(); ++i)
      {
        // Inside a regular mesh nothing is missing.
        if (moments[i].norm() <= 1e-10 * largest)
          continue;
        const auto id = graph.material[i];
        if (stiffnesses.count(id) == 0)
          {
            const auto stiffness = solid_of(id).stiffness();
            for (unsigned int p = 0; p < n_strains; ++p)
              stiffnesses[id].col(p) = kelvin_vector<dim>(stiffness * kelvin_tensor<dim>(p));
          }
        const Stiffness &c = stiffnesses.at(id);
        Incomplete       family{i, moments[i], {}, known_tractions(planes[i], loads, boundaries)};
        const auto       n = static_cast<Eigen::Index>(family.tractions.size());
        family.of_traction.resize(dim, n);
        if (n > 0)
          {
            Eigen::MatrixXd a(n, n_strains);
            for (Eigen::Index row = 0; row < n; ++row)
              for (unsigned int p = 0; p < n_strains; ++p)
                a(row, p) = (kelvin_tensor<dim>(p) *
                             family.tractions[row].plane.normal)[family.tractions[row].component];
            const Eigen::MatrixXd inverse = a.completeOrthogonalDecomposition().pseudoInverse();
            family.of_traction            = moments[i] * c.ldlt().solve(inverse);
            family.of_strain -= family.of_traction * a * c;
          }
        incomplete.push_back(std::move(family));
      }
  }

  template <int dim>
  std::vector<typename MissingBonds<dim>::Moment> MissingBonds<dim>::find_moments() const
  {
    const auto         &graph = gradient.of_faces().graph();
    std::vector<Moment> result(graph.n_owned(), Moment::Zero());
    NodalVector         displacement, force;
    bonds->initialize(displacement);
    bonds->initialize(force);
    // About the middle of the body, for the round-off's sake.
    dealii::Point<dim> middle;
    for (int d = 0; d < dim; ++d)
      {
        double sum = 0;
        for (LocalIndex i = 0; i < graph.n_owned(); ++i)
          sum += graph.position[i][d];
        middle[d] = dealii::Utilities::MPI::sum(sum, graph.communicator) /
                    dealii::Utilities::MPI::sum(static_cast<double>(graph.n_owned()), graph.communicator);
      }
    for (unsigned int p = 0; p < n_strains; ++p)
      {
        for (LocalIndex i = 0; i < graph.n_owned(); ++i)
          {
            const dealii::Tensor<1, dim> u = kelvin_tensor<dim>(p) * (graph.position[i] - middle);
            for (int d = 0; d < dim; ++d)
              displacement.local_element(dim * i + d) = u[d];
          }
        bonds->vmult(force, displacement);
        for (LocalIndex i = 0; i < graph.n_owned(); ++i)
          for (int d = 0; d < dim; ++d)
            result[i](d, p) = force.local_element(dim * i + d);
      }
    return result;
  }

  template <int dim>
  std::vector<typename MissingBonds<dim>::KnownTraction> MissingBonds<dim>::known_tractions(
    const std::vector<SurfacePlane<dim>>                       &planes,
    const Loads<dim>                                           &loads,
    const std::vector<std::vector<dealii::types::boundary_id>> &boundaries) const
  {
    std::vector<KnownTraction> result;
    for (const SurfacePlane<dim> &plane : planes)
      for (unsigned int component = 0; component < dim; ++component)
        {
          KnownTraction known{plane, component, {}};
          bool          is_held = false;
          for (unsigned int k = 0; k < loads.conditions.size(); ++k)
            if (std::count(boundaries[k].begin(), boundaries[k].end(), plane.boundary) > 0)
              {
                is_held |= loads.conditions[k].holds(component);
                if (loads.conditions[k].prescribes_traction())
                  known.conditions.push_back(k);
              }
          if (!is_held)
            result.push_back(known);
        }
    return result;
  }

  template <int dim>
  void MissingBonds<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    bonds->vmult(force, displacement);
    gradient.read(displacement);
    for (const Incomplete &family : incomplete)
      {
        const Eigen::Matrix<double, dim, 1> missing =
          family.of_strain * kelvin_vector<dim>(symmetrize(gradient.at(family.node)));
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * family.node + d) -= missing[d];
      }
  }

  template <int dim>
  void MissingBonds<dim>::add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    for (const Incomplete &family : incomplete)
      for (std::size_t column = 0; column < family.tractions.size(); ++column)
        {
          const KnownTraction &known = family.tractions[column];
          double               value = 0;
          for (const unsigned int k : known.conditions)
            value += Loads<dim>::traction(
              loads.conditions[k], known.plane.point, known.plane.normal, time)[known.component];
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * family.node + d) += family.of_traction(d, column) * value;
        }
  }

  template <int dim>
  dealii::Tensor<2, dim> MissingBonds<dim>::block(const Incomplete             &family,
                                                  const dealii::Tensor<1, dim> &entry) const
  {
    dealii::Tensor<2, dim> result;
    for (int b = 0; b < dim; ++b)
      {
        dealii::Tensor<1, dim> unit;
        unit[b]           = 1.;
        const auto strain = kelvin_vector<dim>(symmetrize(outer_product(unit, entry)));
        const Eigen::Matrix<double, dim, 1> missing = family.of_strain * strain;
        for (int a = 0; a < dim; ++a)
          result[a][b] = missing[a];
      }
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> MissingBonds<dim>::diagonal_blocks() const
  {
    auto        result = bonds->diagonal_blocks();
    const auto &rows   = gradient.rows();
    for (const Incomplete &family : incomplete)
      for (BondIndex m = rows.first[family.node]; m < rows.first[family.node + 1]; ++m)
        if (rows.column[m] == family.node)
          result[family.node] -= block(family, rows.value[m]);
    return result;
  }

  template <int dim>
  void MissingBonds<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    bonds->assemble(add);
    const auto              &rows = gradient.rows();
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    for (const Incomplete &family : incomplete)
      {
        // Rows of the node alone, the first ones.
        const BondIndex   begin = rows.first[family.node], end = rows.first[family.node + 1];
        const std::size_t size = dim * (end - begin + 1);
        unknowns.clear();
        for (int d = 0; d < dim; ++d)
          unknowns.push_back(dim * gradient.of_faces().graph().global_number(family.node) + d);
        values.assign(size * size, 0.);
        for (BondIndex m = begin; m < end; ++m)
          {
            const auto entry = block(family, rows.value[m]);
            for (int b = 0; b < dim; ++b)
              {
                for (int a = 0; a < dim; ++a)
                  values[a * size + unknowns.size()] = -entry[a][b];
                unknowns.push_back(dim * gradient.global_number(m) + b);
              }
          }
        add(unknowns, values);
      }
  }

  template <int dim>
  std::size_t MissingBonds<dim>::memory_consumption() const
  {
    std::size_t result = bonds->memory_consumption() + gradient.memory_consumption();
    for (const Incomplete &family : incomplete)
      result += sizeof(family) + family.of_traction.size() * sizeof(double) +
                family.tractions.size() * sizeof(KnownTraction);
    return result;
  }

  template class MissingBonds<2>;
  template class MissingBonds<3>;
} // namespace perideal
