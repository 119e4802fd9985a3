// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/lanes.h>
#include <perideal/operators/gauss_operator.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Adds what the bonds to n points with displacements v pull at a node with displacement u.
    template <int dim>
    void add_pull(const unsigned int         n,
                  const std::vector<double> *xi,
                  const std::vector<double> &weight,
                  const double              *v,
                  const double              *u,
                  double                    *sum)
    {
      constexpr unsigned int n_lanes    = 4;
      const unsigned int     whole      = n - n % n_lanes;
      Lanes                  total[dim] = {}, distance, x[dim], w;
      for (unsigned int g = 0; g < whole; g += n_lanes)
        {
          Lanes along = {};
          for (int d = 0; d < dim; ++d)
            {
              load(x[d], xi[d].data() + g);
              load(distance, v + d * n + g);
              along += x[d] * (distance - u[d]);
            }
          load(w, weight.data() + g);
          along *= w;
          for (int d = 0; d < dim; ++d)
            total[d] += along * x[d];
        }
      for (int d = 0; d < dim; ++d)
        sum[d] += sum_of_all(total[d]);
      for (unsigned int g = whole; g < n; ++g)
        {
          double along = 0;
          for (int d = 0; d < dim; ++d)
            along += xi[d][g] * (v[d * n + g] - u[d]);
          along *= weight[g];
          for (int d = 0; d < dim; ++d)
            sum[d] += along * xi[d][g];
        }
    }
  } // namespace

  template <int dim>
  GaussOperator<dim>::GaussOperator(const std::shared_ptr<const Families<dim>>    &families,
                                    const std::shared_ptr<const GaussPoints<dim>> &points,
                                    const std::vector<double>                     &modulus,
                                    const Stiffening                              &stiffening)
    : families(families)
    , points(points)
    , far_factor(families->n_local(), 1.)
  {
    const bool stiffens = !stiffening.factor.empty();
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      half_modulus.push_back(0.5 * modulus[i] *
                             (stiffens && !stiffening.of_neighbour ? stiffening.factor[i] : 1.));
    if (stiffens && stiffening.of_neighbour)
      far_factor = stiffening.factor;
    // Rows reach to the nodes of families and of supports.
    const auto       of_families = families->make_partitioner(dim);
    dealii::IndexSet ghosts      = of_families->ghost_indices();
    ghosts.add_indices(points->ghosts());
    this->partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      of_families->locally_owned_range(), ghosts, families->communicator);
    points->initialize(at_points);
    this->reports.resize(families->n_owned());

    unsigned int n_empty = 0;
    Bonds        bonds;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        bool counts = false;
        visit_cells(*families, i, [&](const LocalIndex j) {
          weigh(i, j, bonds);
          counts = counts || std::any_of(bonds.weight.begin(), bonds.weight.end(), [](const double w) {
                     return w > 0;
                   });
        });
        n_empty += counts ? 0 : 1;
      }
    n_empty = dealii::Utilities::MPI::sum(n_empty, families->communicator);
    if (n_empty > 0)
      throw InputError("the horizons of " + std::to_string(n_empty) + " nodes hold no part of a neighbour")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor");
  }

  template <int dim>
  void GaussOperator<dim>::weigh(const LocalIndex i, const LocalIndex j, Bonds &bonds) const
  {
    const unsigned int n      = points->n_points();
    const double      *volume = points->volume(j), *width = points->width(j);
    const double       near = far_factor[j] * half_modulus[i], far = far_factor[j] * half_modulus[j];
    const double       near_horizon = families->horizon[i], far_horizon = families->horizon[j];
    // A point in the node itself has no bond.
    const double smallest = 1e-20 * near_horizon * near_horizon;
    bonds.weight.resize(n);
    std::fill(bonds.weight.begin(), bonds.weight.end(), 0.);
    double *weight = bonds.weight.data();
    for (int d = 0; d < dim; ++d)
      {
        bonds.xi[d].resize(n);
        double       *xi = bonds.xi[d].data();
        const double *x  = points->coordinate(j, d);
        const double  xd = families->position[i][d];
        for (unsigned int g = 0; g < n; ++g)
          {
            xi[g] = x[g] - xd;
            weight[g] += xi[g] * xi[g];
          }
      }
    for (unsigned int g = 0; g < n; ++g)
      {
        const double square = weight[g], length = std::sqrt(square);
        const double modulus = near * linear_share(near_horizon, width[g], length) +
                               far * linear_share(far_horizon, width[g], length);
        weight[g] = square > smallest ? modulus * volume[g] / (square * length) : 0.;
      }
  }

  template <int dim>
  void GaussOperator<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    points->interpolate(displacement, at_points);
    const unsigned int n = points->n_points();
    Bonds              bonds;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        double u[dim], sum[dim] = {};
        for (int d = 0; d < dim; ++d)
          u[d] = displacement.local_element(dim * i + d);
        visit_cells(*families, i, [&](const LocalIndex j) {
          weigh(i, j, bonds);
          add_pull<dim>(n, bonds.xi, bonds.weight, at_points.begin() + std::size_t(dim) * j * n, u, sum);
        });
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) = -families->volume[i] * sum[d];
      }
    at_points.zero_out_ghost_values();
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> GaussOperator<dim>::diagonal_blocks() const
  {
    // Points are looked at where they are owned, for there their supports are known; a node of another rank
    // gets its part from there.
    constexpr unsigned int entries = dim * dim;
    NodalVector            blocks(families->make_partitioner(entries));
    const unsigned int     n = points->n_points();
    Bonds                  bonds;
    for (LocalIndex j = 0; j < families->n_owned(); ++j)
      {
        const auto support = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) {
          weigh(i, j, bonds);
          const auto    at  = std::find(support.begin(), support.end(), families->global_number(i));
          const double *phi = at == support.end() ? nullptr : points->weights(j) + (at - support.begin()) * n;
          for (unsigned int g = 0; g < n; ++g)
            {
              const double weight = families->volume[i] * bonds.weight[g] * (phi ? 1. - phi[g] : 1.);
              for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                  blocks.local_element(entries * i + dim * a + b) += weight * bonds.xi[a][g] * bonds.xi[b][g];
            }
        });
      }
    blocks.compress(dealii::VectorOperation::add);
    std::vector<dealii::Tensor<2, dim>> result(families->n_owned());
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[i][a][b] = blocks.local_element(entries * i + dim * a + b);
    return result;
  }

  template <int dim>
  void GaussOperator<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    const unsigned int       n = points->n_points();
    Bonds                    bonds;
    std::vector<GlobalIndex> nodes, unknowns;
    std::vector<double>      values;
    for (LocalIndex j = 0; j < families->n_owned(); ++j)
      {
        // What the points of this cell do: rows of all nodes with a bond to it, columns of its support too.
        nodes = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) { nodes.push_back(families->global_number(i)); });
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        const auto place = [&](const GlobalIndex number) {
          return dim * (std::lower_bound(nodes.begin(), nodes.end(), number) - nodes.begin());
        };
        const std::size_t size = dim * nodes.size();
        unknowns.clear();
        for (const GlobalIndex number : nodes)
          for (int d = 0; d < dim; ++d)
            unknowns.push_back(dim * number + d);
        values.assign(size * size, 0.);
        const auto support = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) {
          weigh(i, j, bonds);
          const std::size_t row = place(families->global_number(i));
          const auto        put = [&](const std::size_t column, const auto &factor) {
            for (int a = 0; a < dim; ++a)
              for (int b = 0; b < dim; ++b)
                for (unsigned int g = 0; g < n; ++g)
                  values[(row + a) * size + column + b] +=
                    factor(g) * families->volume[i] * bonds.weight[g] * bonds.xi[a][g] * bonds.xi[b][g];
          };
          put(row, [](const unsigned int) { return 1.; });
          for (std::size_t k = 0; k < support.size(); ++k)
            put(place(support[k]), [&](const unsigned int g) { return -points->weights(j)[k * n + g]; });
        });
        add(unknowns, values);
      }
  }

  template <int dim>
  std::size_t GaussOperator<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return points->memory_consumption() + families->memory_consumption() + at_points.memory_consumption() +
           memory_consumption(half_modulus) + memory_consumption(far_factor);
  }

  template class GaussOperator<2>;
  template class GaussOperator<3>;
} // namespace perideal
