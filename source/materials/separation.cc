// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/lanes.h>
#include <perideal/materials/separation.h>

#include <deal.II/base/numbers.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace perideal
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>> directions_of_bonds(const FamilyView<dim> &family,
                                                          const unsigned int     max_normals)
  {
    std::vector<dealii::Tensor<1, dim>> all, result;
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        dealii::Tensor<1, dim> bond;
        for (int d = 0; d < dim; ++d)
          bond[d] = family.bond[d][j];
        all.push_back(bond / bond.norm());
      }
    // One after another, that which is farthest from those there are.
    std::vector<double> nearness(all.size(), 0.);
    while (result.size() < std::min<std::size_t>(max_normals, all.size()))
      {
        const auto next = std::min_element(nearness.begin(), nearness.end()) - nearness.begin();
        if (nearness[next] > 1. - 1e-6)
          break;
        result.push_back(all[next]);
        for (std::size_t k = 0; k < all.size(); ++k)
          nearness[k] = std::max(nearness[k], std::abs(all[k] * result.back()));
      }
    return result;
  }

  template <int dim>
  Separation<dim>::Separation(const FamilyView<dim>                 &family,
                              const FamilyCoefficients              &coefficients,
                              const FamilyShape                     &shape,
                              const dealii::SymmetricTensor<2, dim> &by_normal)
    : family(family)
    , coefficients(coefficients)
    , shape(shape)
    , by_normal(by_normal)
    , left(coefficients, shape)
    , place(family.size)
    , reach(family.size)
    , opening(family.size)
    , parts(family.size)
  {
  }

  template <int dim>
  void Separation<dim>::find_across(const Vector &normal)
  {
    across.clear();
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        reach[j] = 0;
        for (int d = 0; d < dim; ++d)
          reach[j] += family.bond[d][j] * normal[d];
        if (reach[j] > 1e-9 * family.horizon)
          across.push_back(j);
      }
    std::sort(across.begin(), across.end(), [&](const LocalIndex a, const LocalIndex b) {
      return reach[a] > reach[b];
    });
  }

  template <int dim>
  void Separation<dim>::add_side(const Vector              &normal,
                                 const std::vector<double> &squares,
                                 std::vector<double>       &by_member)
  {
    find_across(normal);
    for (std::size_t k = 0; k < across.size(); ++k)
      {
        const LocalIndex j          = across[k];
        const double     of_stretch = family.length_square[j] / reach[j];
        place[j]                    = k;
        parts[j]                    = left.part_of(j, reach[j], normal);
        opening[j]                  = squares[j] * of_stretch * of_stretch;
      }
    order = across;
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return opening[a] < opening[b];
    });
    // Planes between the projections of two members cut all bonds that reach farther.
    for (std::size_t n = 1; n <= across.size(); ++n)
      {
        const double width = reach[across[n - 1]] - (n < across.size() ? reach[across[n]] : 0.);
        if (width <= 1e-12 * family.horizon)
          continue;
        left.clear();
        for (std::size_t k = 0; k < n; ++k)
          left.add(parts[across[k]], 1.);
        double twice = left.twice();
        for (auto first = order.begin(); first != order.end();)
          {
            // Bonds that break at the same opening share what falls, whichever comes first.
            auto         end   = first;
            unsigned int count = 0;
            for (; end != order.end() && opening[*end] <= (1. + 1e-9) * opening[*first]; ++end)
              if (place[*end] < n)
                {
                  left.add(parts[*end], -1.);
                  ++count;
                }
            const double after = left.twice();
            for (; first != end; ++first)
              if (place[*first] < n)
                by_member[*first] +=
                  0.5 * width * opening[*first] * (twice - after) / (count * family.node_volume);
            twice = after;
          }
      }
  }

  template <int dim>
  double Separation<dim>::energy(const Vector              &normal,
                                 const std::vector<double> &squares,
                                 std::vector<double>       &by_member)
  {
    by_member.assign(family.size, 0.);
    add_side(normal, squares, by_member);
    add_side(-normal, squares, by_member);
    return std::accumulate(by_member.begin(), by_member.end(), 0.);
  }

  template <int dim>
  double Separation<dim>::share_of(const Vector              &normal,
                                   const std::vector<double> &squares,
                                   const BondFailing         &how,
                                   std::vector<double>       &by_member)
  {
    const double wanted = (by_normal * normal).norm(), at_once = energy(normal, squares, by_member);
    double       result = at_once;
    if (how.law.softens() && shape.n_sums > 0 && at_once > 0)
      result = softened_side(normal, squares, how) + softened_side(-normal, squares, how);
    for (double &of_member : by_member)
      of_member *= at_once > 0 ? result / (at_once * wanted) : 0.;
    return result / wanted;
  }

  template <int dim>
  std::vector<double> Separation<dim>::of_continuum() const
  {
    const dealii::SymmetricTensor<2, dim> inverse = invert(by_normal);
    std::vector<double>                   squares(family.size);
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        Vector bond;
        for (int d = 0; d < dim; ++d)
          bond[d] = family.bond[d][j];
        // |n.xi| summed over the ellipsoid xi = G omega is |G n|.
        squares[j] = std::pow((inverse * bond).norm() / bond.norm(), -(dim + 1)) / determinant(by_normal);
      }
    return squares;
  }

  template <int dim>
  std::vector<double> Separation<dim>::calibrate(const BondFailing         &how,
                                                 const std::vector<Vector> &normals,
                                                 const unsigned int         n_steps,
                                                 const std::vector<double> &begin)
  {
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    // Share of the mean square of the rows that keeps stretches alike, and what a step may change.
    constexpr double regularisation = 0.01, largest_change = 0.3;

    if (normals.empty())
      return std::vector<double>(family.size, 0.);
    std::vector<double> squares = begin, by_member;
    if (how.first > 0)
      {
        // Where bonds soften from a given stretch on, their share depends on how large the others are.
        double mean = 0;
        for (const Vector &normal : normals)
          mean += energy(normal, squares, by_member) / ((by_normal * normal).norm() * normals.size());
        if (mean > 0)
          for (double &square : squares)
            square /= mean;
      }
    MatrixXd matrix(normals.size(), family.size);
    VectorXd energies(normals.size());
    for (unsigned int step = 0; step <= n_steps; ++step)
      {
        for (Eigen::Index n = 0; n < energies.size(); ++n)
          {
            energies[n]   = share_of(normals[n], squares, how, by_member);
            matrix.row(n) = Eigen::Map<const VectorXd>(by_member.data(), family.size).transpose();
          }
        const double mean = energies.mean();
        if (!(mean > 0))
          return std::vector<double>(family.size, 0.);
        if (step == 0 || step == n_steps)
          {
            // What is left of differences counts for no direction more than for another.
            for (double &square : squares)
              square /= mean;
            matrix /= mean;
            energies /= mean;
          }
        if (step == n_steps)
          break;
        MatrixXd normal_matrix = matrix * matrix.transpose();
        normal_matrix.diagonal().array() += regularisation * normal_matrix.trace() / energies.size();
        const VectorXd change =
          matrix.transpose() * normal_matrix.llt().solve(VectorXd::Ones(energies.size()) - energies);
        for (LocalIndex j = 0; j < family.size; ++j)
          squares[j] *= 1. + std::clamp(change[j], -largest_change, largest_change);
      }
    return squares;
  }

  template <int dim>
  double Separation<dim>::softened_side(const Vector              &normal,
                                        const std::vector<double> &squares,
                                        const BondFailing         &how)
  {
    // In equal steps of log(w); W is the energy of what is left of the bonds, for planes at all distances.
    constexpr unsigned int n_steps = 100;
    find_across(normal);
    struct Bond
    {
      double first, square, of_opening;
      bool   softens;
      /// Stretch where it has gone.
      double end;
    };
    std::vector<Bond> bonds_across;
    bonds_across.reserve(across.size());
    double lowest = std::numeric_limits<double>::infinity(), highest = 0;
    for (std::size_t n = 0; n < across.size(); ++n)
      {
        const LocalIndex j = across[n];
        Bond             bond;
        bond.square     = how.energy * squares[j];
        bond.first      = how.first > 0 ? how.first : how.first_share * std::sqrt(bond.square);
        bond.of_opening = reach[j] / family.length_square[j];
        bond.softens    = how.law.is_stable(bond.first, bond.square);
        bond.end        = bond.softens ? how.law.last(bond.first, bond.square) : std::sqrt(bond.square);
        lowest          = std::min(lowest, (bond.softens ? bond.first : bond.end) / bond.of_opening);
        highest         = std::max(highest, bond.end / bond.of_opening);
        bonds_across.push_back(bond);
      }
    if (!(highest > 0) || !(lowest > 0))
      return 0;
    const double                 width   = std::log(highest / lowest) / n_steps;
    constexpr unsigned int       n_lanes = 4, n_groups = n_steps / n_lanes + 1, n_points = n_lanes * n_groups;
    std::array<double, n_points> openings, inverse, left_of_bond;
    // Below the first point all bonds are whole, and W grows with w^2; behind the last none is left.
    const double ratio = std::exp(width), inverse_ratio = 1. / ratio;
    openings[0] = lowest;
    openings[1] = lowest * std::exp(0.5 * width);
    inverse[0]  = 1. / openings[0];
    inverse[1]  = 1. / openings[1];
    for (unsigned int k = 2; k < n_points; ++k)
      {
        openings[k] = ratio * openings[k - 1];
        inverse[k]  = inverse_ratio * inverse[k - 1];
      }
    const SofteningLaw::Growing           opening{openings.data(), inverse.data(), n_points};
    std::vector<FamilyEnergy<dim, Lanes>> left_at(n_groups, FamilyEnergy<dim, Lanes>(coefficients, shape));
    std::array<Lanes, n_groups>           energies = {};
    for (std::size_t n = 0; n < across.size(); ++n)
      {
        const LocalIndex j     = across[n];
        const Bond      &bond  = bonds_across[n];
        const double     layer = reach[j] - (n + 1 < across.size() ? reach[across[n + 1]] : 0.);
        if (bond.softens)
          how.law.look_along(opening, bond.of_opening, bond.first, bond.square, left_of_bond.data());
        else
          for (unsigned int k = 0; k < n_points; ++k)
            left_of_bond[k] = openings[k] * bond.of_opening < bond.end ? 1. : 0.;
        const auto part = left_at[0].part_of(j, reach[j], normal);
        for (unsigned int g = 0; g < n_groups; ++g)
          {
            Lanes share;
            load(share, &left_of_bond[n_lanes * g]);
            left_at[g].add(part, share);
            energies[g] += layer * left_at[g].twice();
          }
      }
    double work = 0;
    for (unsigned int k = 0; k <= n_steps; ++k)
      work += (k == 0 ? 0.5 : width) * openings[k] * openings[k] * energies[k / n_lanes][k % n_lanes];
    return work / (family.node_volume * how.energy);
  }

  template <int dim>
  EnergyByDirection Separation<dim>::by_direction(const std::vector<double> &squares, const BondFailing &how)
  {
    using dealii::numbers::PI;
    constexpr unsigned int n = dim == 2 ? 36 : 64;
    EnergyByDirection      result{0., std::numeric_limits<double>::infinity(), 0.};
    std::vector<double>    by_member;
    for (unsigned int k = 0; k < n; ++k)
      {
        // A half of all directions; in 3-D on a Fibonacci spiral.
        const double angle = dim == 2 ? PI * k / n : PI * (3. - std::sqrt(5.)) * k;
        const double z = dim == 2 ? 0. : (k + 0.5) / n, r = std::sqrt(1. - z * z);
        Vector       normal;
        normal[0]             = r * std::cos(angle);
        normal[1]             = r * std::sin(angle);
        normal[dim - 1]       = dim == 2 ? normal[1] : z;
        const double of_plane = share_of(normal, squares, how, by_member);
        result.mean += of_plane / n;
        result.smallest = std::min(result.smallest, of_plane);
        result.largest  = std::max(result.largest, of_plane);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(directions_of_bonds)
  PERIDEAL_INSTANTIATE_CLASS(Separation)
} // namespace perideal
