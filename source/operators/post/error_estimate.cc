// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/boundary_faces.h>
#include <perideal/operators/post/error_estimate.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace perideal
{
  double ErrorEstimate::with_cells(const double factor) const
  {
    return smooth * std::pow(factor, 4.) + rough * std::pow(factor, factor < 1. ? 1.2 : 4.) +
           surface * std::pow(factor, 3.5);
  }

  double ErrorEstimate::factor_for(const double error) const
  {
    double lower = 1e-3, upper = 1e3;
    while (upper > 1.001 * lower)
      {
        const double middle                          = std::sqrt(lower * upper);
        (with_cells(middle) > error ? upper : lower) = middle;
      }
    return std::sqrt(lower * upper);
  }

  namespace
  {
    /// n.C.n of a unit normal [Pa].
    template <int dim>
    dealii::SymmetricTensor<2, dim> acoustic_tensor(const dealii::SymmetricTensor<4, dim> &stiffness,
                                                    const dealii::Tensor<1, dim>          &normal)
    {
      dealii::SymmetricTensor<2, dim> result;
      for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              result[a][b] += normal[k] * stiffness[a][k][b][l] * normal[l];
      return result;
    }

    /// The polynomials of all cells that a rank knows, and what is wrong with them at the faces.
    template <int dim>
    class Indicators
    {
    public:
      Indicators(const GradientMoments<dim> &moments,
                 const SolidOf<dim>         &solid_of,
                 const NodalVector          &displacement)
        : cells(moments.cell_polynomials())
        , faces(moments.faces())
        , prescribed(moments.prescribed_values())
        , n_owned(moments.n_owned())
        , jumps(n_owned)
        , tractions(n_owned)
        , curvatures(n_owned)
        , squares_by_traction(n_owned)
        , squares_by_gap(n_owned)
      {
        for (const auto id : cells.graph().material)
          if (stiffness.count(id) == 0)
            stiffness[id] = solid_of(id).stiffness();
        read_polynomials(moments, displacement);
        add_strain_energy();
      }

      /// Adds the energy of the jumps, half to each side.
      void add_jumps();

      /// Adds what the boundary does not have of its loads.
      void add_boundary(const Loads<dim> &loads, const double time);

      /// The estimate. Collective.
      ErrorEstimate combine(const std::vector<dealii::Tensor<1, dim>> &at_nodes) const;

    private:
      using Vector                          = dealii::Tensor<1, dim>;
      static constexpr unsigned int n_terms = Monomials<dim>::n_coefficients;
      /// Coefficients of the monomials about the centroid.
      using Polynomial = std::array<Vector, n_terms>;

      void read_polynomials(const GradientMoments<dim> &moments, const NodalVector &displacement);
      void add_strain_energy();

      /// What a cell adds to the quotient of energies [J].
      double of_energy(const LocalIndex i) const { return 1.5 * jumps[i] + tractions[i] / 3.; }

      const dealii::SymmetricTensor<4, dim> &stiffness_of(const LocalIndex i) const
      {
        return stiffness.at(cells.graph().material[i]);
      }
      Vector                          value(const LocalIndex i, const Vector &x) const;
      dealii::SymmetricTensor<2, dim> strain(const LocalIndex i, const Vector &x) const;
      /// Strain by the distance along an axis.
      dealii::SymmetricTensor<2, dim> strain_slope(const LocalIndex i, const unsigned int axis) const;
      void                            add_at(const BoundaryPoint<dim>    &point,
                                             const Vector                &traction,
                                             const Vector                &gap,
                                             const std::array<bool, dim> &held);

      const CellPolynomials<dim>                                           &cells;
      const FaceMoments<dim>                                               &faces;
      const FaceValues<dim>                                                &prescribed;
      const LocalIndex                                                      n_owned;
      std::map<dealii::types::material_id, dealii::SymmetricTensor<4, dim>> stiffness;
      std::vector<Polynomial>                                               polynomials;
      /// Energies of owned cells [J]: of jumps, of unmet tractions, and of the quadratic terms.
      std::vector<double> jumps, tractions, curvatures;
      /// Integrals of h^3 |Q^-1 r|^2 and h |p - u_b|^2 over their boundaries [m^5].
      std::vector<double> squares_by_traction, squares_by_gap;
      /// Of this rank: the strain energy, and what rounding leaves of it at rest [J].
      double energy = 0, rounding = 0;
    };

    template <int dim>
    void Indicators<dim>::read_polynomials(const GradientMoments<dim> &moments,
                                           const NodalVector          &displacement)
    {
      moments.read(displacement, GradientMoments<dim>::AtFaces::nothing);
      std::vector<Polynomial> own(n_owned);
      for (LocalIndex i = 0; i < n_owned; ++i)
        for (unsigned int m = 0; m < n_terms; ++m)
          for (int a = 0; a < dim; ++a)
            own[i][m][a] = moments.polynomial(i)[m].value[a];
      polynomials = cells.graph().with_ghosts(own);
    }

    template <int dim>
    dealii::Tensor<1, dim> Indicators<dim>::value(const LocalIndex i, const Vector &x) const
    {
      std::array<double, Monomials<dim>::n> monomial;
      Monomials<dim>::evaluate(x, monomial);
      Vector result;
      for (unsigned int m = 0; m < n_terms; ++m)
        result += monomial[m] * polynomials[i][m];
      return result;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim> Indicators<dim>::strain_slope(const LocalIndex   i,
                                                                  const unsigned int axis) const
    {
      dealii::Tensor<2, dim> gradient;
      for (unsigned int p = 0; p < Monomials<dim>::n_quadratic; ++p)
        {
          const auto [k, l]       = SymmetricPairs<dim>::axes(p);
          const Vector &quadratic = polynomials[i][1 + dim + p];
          for (int a = 0; a < dim; ++a)
            {
              gradient[a][k] += l == axis ? quadratic[a] : 0.;
              gradient[a][l] += k == axis ? quadratic[a] : 0.;
            }
        }
      return symmetrize(gradient);
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim> Indicators<dim>::strain(const LocalIndex i, const Vector &x) const
    {
      dealii::Tensor<2, dim> gradient;
      for (int a = 0; a < dim; ++a)
        for (int l = 0; l < dim; ++l)
          gradient[a][l] = polynomials[i][1 + l][a];
      auto result = symmetrize(gradient);
      for (int k = 0; k < dim; ++k)
        result += x[k] * strain_slope(i, k);
      return result;
    }

    template <int dim>
    void Indicators<dim>::add_strain_energy()
    {
      for (LocalIndex i = 0; i < n_owned; ++i)
        {
          const double half_volume = 0.5 * cells.volumes()[i];
          const auto  &C           = stiffness_of(i);
          const auto   mean        = strain(i, Vector());
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              curvatures[i] += half_volume * cells.second_moments()[i][k][l] *
                               (strain_slope(i, k) * (C * strain_slope(i, l)));
          energy += half_volume * (mean * (C * mean)) + curvatures[i];
          rounding += 1e-24 * half_volume * C[0][0][0][0] * polynomials[i][0].norm_square() /
                      trace(cells.second_moments()[i]);
        }
    }

    template <int dim>
    void Indicators<dim>::add_jumps()
    {
      for (std::size_t f = 0; f < faces.n_inner_faces(); ++f)
        {
          const auto &face  = faces.faces()[f];
          const auto &shape = faces.shape_of(face);
          // The area is the integral of the monomial 1 with the normal.
          const double *moments = faces.moments_of(shape);
          Vector        area;
          for (int l = 0; l < dim; ++l)
            area[l] = shape.is_plane ? moments[l] * moments[dim] : moments[l * Monomials<dim>::n];
          const auto [i, j]            = face.node;
          const auto &[from_i, from_j] = shape.offset;
          const Vector jump = value(j, from_j) - value(i, from_i), normal = area / area.norm();
          const auto   mean_of_both =
            0.5 * (acoustic_tensor(stiffness_of(i), normal) + acoustic_tensor(stiffness_of(j), normal));
          const double of_face =
            0.5 * area.norm() / (from_i - from_j).norm() * (jump * (mean_of_both * jump));
          for (const LocalIndex side : {i, j})
            if (side < n_owned)
              jumps[side] += 0.5 * of_face;
        }
    }

    template <int dim>
    void Indicators<dim>::add_at(const BoundaryPoint<dim>    &point,
                                 const Vector                &traction,
                                 const Vector                &gap,
                                 const std::array<bool, dim> &held)
    {
      const LocalIndex i      = point.node;
      const double     area   = point.area.norm();
      const Vector     normal = point.area / area, x = point.point - cells.centroids()[i];
      const double     h       = 2. * std::abs(x * normal);
      Vector           lacking = traction - Vector(stiffness_of(i) * strain(i, x) * normal);
      for (int d = 0; d < dim; ++d)
        if (held[d])
          lacking[d] = 0;
      const Vector opening = invert(acoustic_tensor(stiffness_of(i), normal)) * lacking;
      tractions[i] += 0.5 * area * h * (lacking * opening);
      squares_by_traction[i] += area * h * h * h * opening.norm_square();
      squares_by_gap[i] += area * h * gap.norm_square();
    }

    template <int dim>
    void Indicators<dim>::add_boundary(const Loads<dim> &loads, const double time)
    {
      const auto                        &points = faces.boundary_points();
      std::vector<Vector>                traction(points.size()), gap(points.size());
      std::vector<std::array<bool, dim>> held(points.size());
      visit_loaded_faces(
        loads, points, [&](const BoundaryCondition<dim> &condition, const BoundaryPoint<dim> &point) {
          traction[&point - points.data()] +=
            Loads<dim>::traction(condition, point.point, point.area / point.area.norm(), time);
        });
      for (const auto &entry : prescribed.entries())
        {
          const auto  &point    = points[entry.point];
          const Vector computed = value(point.node, point.point - cells.centroids()[point.node]);
          if (entry.sliding_condition != FaceValues<dim>::free)
            {
              // The traction along the face is not judged.
              held[entry.point].fill(true);
              gap[entry.point] = (computed * entry.normal) * entry.normal;
              continue;
            }
          for (int d = 0; d < dim; ++d)
            if ((held[entry.point][d] = entry.condition[d] != FaceValues<dim>::free))
              gap[entry.point][d] = computed[d] - entry.value[d];
        }
      for (std::size_t p = 0; p < points.size(); ++p)
        add_at(points[p], traction[p], gap[p], held[p]);
    }

    template <int dim>
    ErrorEstimate Indicators<dim>::combine(const std::vector<Vector> &at_nodes) const
    {
      const MPI_Comm communicator = cells.graph().communicator;
      const auto     of_all = [&](const auto &x) { return dealii::Utilities::MPI::sum(x, communicator); };
      double         volume = 0, square = 0, smooth = 0, rough = 0, by_traction = 0, by_gap = 0;
      Vector         mean;
      for (LocalIndex i = 0; i < n_owned; ++i)
        {
          volume += cells.volumes()[i];
          square += cells.volumes()[i] * at_nodes[i].norm_square();
          mean += cells.volumes()[i] * at_nodes[i];
          (jumps[i] > 0.05 * curvatures[i] ? rough : smooth) += of_energy(i);
          by_traction += squares_by_traction[i];
          by_gap += squares_by_gap[i];
        }
      const double  all_volume = of_all(volume), all_square = of_all(square), all_energy = of_all(energy);
      ErrorEstimate result;
      result.of_cells.assign(n_owned, 0.);
      if (!(all_energy > of_all(rounding)) || !(all_square > 0))
        return result;
      const double varying =
        std::sqrt(std::max(0., 1. - of_all(mean).norm_square() / all_volume / all_square));
      result.smooth                = varying * of_all(smooth) / all_energy;
      result.rough                 = varying * of_all(rough) / all_energy;
      const double all_by_traction = of_all(by_traction), all_by_gap = of_all(by_gap);
      result.surface =
        0.25 * std::sqrt(all_by_traction / all_square) + 0.5 * std::sqrt(all_by_gap / all_square);

      // A part of a root: sqrt(sum) = sum of x/sqrt(sum).
      const auto of_root = [all_square](const double part, const double all) {
        return part > 0 ? part / std::sqrt(all * all_square) : 0.;
      };
      for (LocalIndex i = 0; i < n_owned; ++i)
        result.of_cells[i] = varying * of_energy(i) / all_energy +
                             0.25 * of_root(squares_by_traction[i], all_by_traction) +
                             0.5 * of_root(squares_by_gap[i], all_by_gap);
      return result;
    }
  } // namespace

  template <int dim>
  ErrorEstimate estimate_error(const GradientMoments<dim>                &moments,
                               const SolidOf<dim>                        &solid_of,
                               const Loads<dim>                          &loads,
                               const double                               time,
                               const NodalVector                         &displacement,
                               const std::vector<dealii::Tensor<1, dim>> &at_nodes)
  {
    Indicators<dim> indicators(moments, solid_of, displacement);
    indicators.add_jumps();
    indicators.add_boundary(loads, time);
    return indicators.combine(at_nodes);
  }

  PERIDEAL_INSTANTIATE(estimate_error)
} // namespace perideal
