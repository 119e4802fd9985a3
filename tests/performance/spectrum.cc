// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/linear/correspondence_tangent.h>
#include <perideal/operators/linear/surface_cure.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "dense_matrix.h"
#include "moments.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

// Eigenvalues of free bodies: of the correspondence model by the family's gradient (VNOSB fig. 2), with and
// without the penalty (21)-(23), by the radius of the horizon; then of every model, on squares and cubes and
// on distorted ones: zero modes, eigenvalues below zero, the first behind the rigid-body motions, the lowest
// and the largest imaginary part, these over the largest. The operator of the paper's form is not symmetric:
// real parts.
//
//     performance_spectrum [models]    only the second table

using namespace perideal;

namespace
{
  constexpr double poisson_ratio = 0.3;
  /// Share of the largest eigenvalue below which one is round-off.
  constexpr double round_off = 1e-12;

  struct Variant
  {
    std::string model, form, stabilisation;
  };

  const std::vector<Variant> variants = {{"bond based", "energy", "automatic"},
                                         {"ordinary", "energy", "automatic"},
                                         {"extended ordinary", "paper", "automatic"},
                                         {"extended ordinary", "energy", "automatic"},
                                         {"extended ordinary", "consistent", "automatic"},
                                         {"tensor involved", "one point", "automatic"},
                                         {"tensor involved", "moment corrected", "automatic"},
                                         {"tensor involved", "surface cure", "automatic"},
                                         {"tensor involved", "consistent", "automatic"},
                                         {"correspondence", "family", "0"},
                                         {"correspondence", "family", "automatic"}};

  template <int dim>
  ElasticConstants constants()
  {
    return {1., poisson_ratio, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid};
  }

  /// The linear operator of a free body at rest.
  template <int dim>
  std::shared_ptr<BondOperator<dim>>
  create_operator(const Mesh<dim> &mesh, const test::Body<dim> &body, const Variant &variant)
  {
    ModelParameters parameters;
    parameters.model         = variant.model;
    parameters.form          = variant.form;
    parameters.stabilisation = variant.stabilisation;
    parameters.resolve(dim, ModelParameters::Use::statics);
    const ElasticSolid<dim> solid(parameters.constants_of_model(constants<dim>()));
    const SolidOf<dim>      solid_of = [solid](const dealii::types::material_id) { return solid; };
    const auto              gradient =
      std::make_shared<const FaceGradient<dim>>(mesh, body.nodes, [](const auto) { return 1.; });
    if (parameters.is_correspondence() && !parameters.is_consistent())
      {
        const auto rows = std::make_shared<CorrespondenceRows<dim>>(
          body.families, create_correspondence<dim>(parameters), solid_of);
        const LawsByMaterial<dim> laws = {{0, create_law<dim>("linear elastic", solid)}};
        return std::make_shared<CorrespondenceTangent<dim>>(body.families, rows, laws);
      }
    if (parameters.is_consistent())
      {
        const double own = parameters.form_traits().defaults.horizon_factor;
        return test::make_consistent_operator<dim>(
          test::Body<dim>(mesh, own).families,
          test::make_moments(mesh, body.nodes, std::make_shared<const FaceValues<dim>>()),
          create_consistent<dim>(parameters, own),
          solid_of);
      }
    std::shared_ptr<BondOperator<dim>> bonds =
      create_bond_operator<dim>(body.families, *create_model<dim>(parameters, 1.), solid_of);
    if (parameters.has_surface_cure())
      bonds = std::make_shared<SurfaceCure<dim>>(bonds, gradient, body.nodes.volume, solid_of);
    return bonds;
  }

  /// What the eigenvalues of a free body are.
  struct Spectrum
  {
    unsigned int n_zero = 0, n_negative = 0;
    /// The first behind the rigid-body motions, the lowest, and the largest imaginary part, over the largest.
    double first = 0, lowest = 0, imaginary = 0;
  };

  /// Real parts, which are the eigenvalues of symmetric operators.
  template <int dim>
  Spectrum measure(const BondOperator<dim> &bonds)
  {
    Spectrum            result;
    std::vector<double> values;
    if (bonds.is_symmetric())
      for (const double value : test::spectrum(bonds))
        values.push_back(value);
    else
      for (const auto &value : test::complex_spectrum(bonds))
        {
          values.push_back(value.real());
          result.imaginary = std::max(result.imaginary, std::abs(value.imag()));
        }
    std::sort(values.begin(), values.end());
    const double largest = values.back();
    const auto   is_zero = [&](const double value) { return std::abs(value) < round_off * largest; };
    result.n_zero        = std::count_if(values.begin(), values.end(), is_zero);
    result.n_negative    = std::count_if(
      values.begin(), values.end(), [&](const double value) { return value <= -round_off * largest; });
    result.lowest = values.front() / largest;
    // By size: a rigid-body motion must not hide behind a negative eigenvalue.
    std::sort(
      values.begin(), values.end(), [](const double a, const double b) { return std::abs(a) < std::abs(b); });
    result.first = values[dim * (dim + 1) / 2] / largest;
    result.imaginary /= largest;
    return result;
  }

  void print_correspondence(const double horizon_factor, const std::string &stabilisation)
  {
    const auto          mesh = test::make_box<2>({24, 24}, {1., 1.}, 0.);
    const test::Body<2> body(*mesh, horizon_factor);
    const Spectrum      values =
      measure(*create_operator<2>(*mesh, body, {"correspondence", "family", stabilisation}));
    std::cout << "| " << horizon_factor << " | " << stabilisation << " | " << values.n_zero << " | "
              << values.first << " |" << std::endl;
  }

  template <int dim>
  void print_models(const std::vector<unsigned int> &cells, const double distortion)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    const double          horizon_factor = 3.015;
    const auto            mesh           = test::make_box<dim>(cells, size, distortion);
    const test::Body<dim> body(*mesh, horizon_factor);
    for (const Variant &variant : variants)
      {
        const Spectrum values = measure(*create_operator<dim>(*mesh, body, variant));
        std::cout << "| " << variant.model << " | " << variant.form
                  << (variant.stabilisation == "0" ? ", no penalty" : "") << " | " << dim << " | "
                  << distortion << " | " << values.n_zero << " | " << values.n_negative << " | "
                  << values.first << " | " << values.lowest << " | " << values.imaginary << " |" << std::endl;
      }
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout.precision(4);
  const bool only_models = argc > 1 && std::string(argv[1]) == "models";
  if (!only_models)
    {
      std::cout << "| horizon over spacing | alpha over E | zero modes | fourth over largest eigenvalue |\n"
                << "|--:|--:|--:|--:|\n";
      for (const double horizon_factor : {1.5, 2.015, 3.015})
        for (const std::string stabilisation : {"0", "5"})
          print_correspondence(horizon_factor, stabilisation);
      std::cout << '\n';
    }
  std::cout << "| model | form | dim | distortion | zero modes | negative | first | "
               "lowest | largest imaginary part |\n"
            << "|---|---|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const double distortion : {0., 0.3})
    {
      print_models<2>({14, 14}, distortion);
      print_models<3>({6, 6, 6}, distortion);
    }
}
