// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/bulk_strength.h>
#include <perideal/operators/weights/calibrated_stretches.h>
#include <perideal/operators/weights/calibration_memo.h>
#include <perideal/operators/weights/canonical_family.h>
#include <perideal/operators/weights/equal_families.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// The cost goes with the square of the number of members and that of the normals: large families that
    /// are all different, as in unstructured meshes of solids, are only scaled.
    constexpr unsigned int most_normals = 24, few_normals = 8, large_family = 64;

    /// Steps of Newton's method in all, and those of them before it is known where bonds begin to soften.
    constexpr unsigned int n_steps = 5, n_first_steps = 2;

    /// Share of the square of the stretch of a continuum below which no family takes its bonds: the least are
    /// .4 to .6 in families of equal cells and of unstructured meshes, .2 in corners, .01 where cells halve.
    constexpr double least_share = 0.3;
    /// Share of the strain of the tensile strength below which no family begins to soften: .75 to .84 do.
    constexpr double least_first = 0.6;

    /// Different families that are calibrated whether they are wanted or not, at some 20 ms each: structured
    /// meshes have no more.
    constexpr std::size_t n_at_once = 64;

    /// The least that a family can be calibrated to, which says that it is not.
    template <int dim>
    CalibratedFamily least_of(const FamilyView<dim>           &family,
                              const Calibration<dim>          &how,
                              const dealii::types::material_id material)
    {
      const BondFracture<dim> fracture = how.fracture_of(material);
      // Separation::of_continuum() of the direction in which it is least.
      const double smallest     = eigenvalues(fracture.by_normal)[dim - 1],
                   of_direction = std::pow(smallest, dim + 1) / determinant(fracture.by_normal);
      CalibratedFamily result;
      result.squares.assign(family.size,
                            -least_share * of_direction * how.of_continuum(material, family.horizon));
      result.first = least_first * fracture.of_strength;
      return result;
    }

    template <int dim>
    CalibratedFamily calibrate(const FamilyView<dim>           &family,
                               LinearModel<dim>                &model,
                               const Calibration<dim>          &how,
                               const dealii::types::material_id material,
                               const bool                       is_one_of_many)
    {
      const BondFracture<dim> fracture = how.fracture_of(material);
      FamilyCoefficients      coefficients;
      const FamilyShape       shape = model.shape();
      coefficients.resize(family.size, shape);
      model.compute(family, coefficients);
      Separation<dim>    separation(family, coefficients, shape, fracture.by_normal);
      CalibratedFamily   result;
      const bool         only_scale = is_one_of_many && family.size > large_family;
      BondFailing        failing{how.law, fracture.energy, fracture.of_strength, how.first_share};
      const auto         normals = directions_of_bonds(family, only_scale ? few_normals : most_normals);
      const bool         bears   = how.law.softens() && fracture.of_strength > 0 && !normals.empty();
      const unsigned int n = only_scale ? 0 : n_steps, n_first = only_scale || !bears ? n : n_first_steps;
      result.squares = separation.calibrate(failing, normals, n_first, separation.of_continuum());
      if (bears)
        {
          const BulkStrength<dim> strength(family, coefficients, shape, normals, fracture.lateral);
          failing.first  = strength.first_stretch(fracture.of_strength, result.squares, failing);
          result.squares = separation.calibrate(failing, normals, n - n_first, result.squares);
        }
      result.first = std::max(failing.first, least_first * fracture.of_strength);
      if (how.of_continuum)
        {
          const double              least        = least_share * how.of_continuum(material, family.horizon);
          const std::vector<double> of_continuum = separation.of_continuum();
          for (unsigned int j = 0; j < result.squares.size(); ++j)
            result.squares[j] = std::max(result.squares[j], least * of_continuum[j]);
        }
      if (how.with_shares)
        result.shares = separation.by_direction(result.squares, failing);
      return result;
    }

    /// One of the different families.
    template <int dim>
    struct Known
    {
      /// The first that was found.
      FamilyView<dim> first;
      /// What it is calibrated to, or the least that this can be, and the code of its first member.
      CalibratedFamily made;
      LocalIndex       first_code;
      bool             is_calibrated = false;
    };

    /// A family without the rounding of coordinates: numbers with so many bits that equal families get the
    /// same ones nearly always.
    template <int dim>
    FamilyView<dim> without_rounding(FamilyView<dim> family)
    {
      constexpr int n_bits = 36;
      const auto    round  = [](const double value, const double scale) {
        const double unit = std::ldexp(1., std::ilogb(scale) - n_bits);
        return std::nearbyint(value / unit) * unit;
      };
      family.node_volume = round(family.node_volume, family.node_volume);
      for (auto *values : {&family.volume, &family.bond_horizon})
        for (double &value : *values)
          value = value > 0 ? round(value, value) : value;
      std::fill(family.length_square.begin(), family.length_square.end(), 0.);
      for (auto &components : family.bond)
        for (LocalIndex j = 0; j < family.size; ++j)
          {
            components[j] = round(components[j], family.horizon);
            family.length_square[j] += components[j] * components[j];
          }
      family.horizon = round(family.horizon, family.horizon);
      return family;
    }

    /// As calibrate(), or what the memo knows of it; of all images of a family one is calibrated.
    template <int dim>
    CalibratedFamily recall(const FamilyView<dim>           &given,
                            LinearModel<dim>                &model,
                            const Calibration<dim>          &how,
                            const dealii::types::material_id material,
                            const bool                       has_images,
                            const bool                       is_one_of_many)
    {
      const auto canonical = canonical_family(without_rounding(given), has_images);
      const auto make = [&] { return calibrate(canonical.family, model, how, material, is_one_of_many); };
      CalibratedFamily result;
      if (how.memo == nullptr || model.depends_on_node())
        result = make();
      else
        {
          const auto key =
            CalibrationMemo::key_of(canonical.family, material, 2u * is_one_of_many + how.with_shares);
          const CalibratedFamily *known = how.memo->find(key);
          result                        = known != nullptr ? *known : make();
          if (known == nullptr)
            how.memo->insert(key, result);
        }
      const std::vector<double> squares = result.squares;
      for (LocalIndex k = 0; k < squares.size(); ++k)
        result.squares[canonical.member_of[k]] = squares[k];
      return result;
    }

    /// Whether bonds of a material fail alike in all directions.
    template <int dim>
    bool is_isotropic(const ElasticSolid<dim> &solid, const BondFracture<dim> &fracture)
    {
      return solid.is_isotropic() &&
             fracture.by_normal == fracture.by_normal[0][0] * dealii::unit_symmetric_tensor<dim>();
    }
  } // namespace

  template <int dim>
  CalibratedStretches calibrate_stretches(const Families<dim>    &families,
                                          const BondList         &bonds,
                                          LinearModel<dim>       &model,
                                          const SolidOf<dim>     &solid_of,
                                          const Calibration<dim> &how)
  {
    const auto is_wanted = [&](const LocalIndex i) {
      return !how.is_wanted || !how.of_continuum || how.is_wanted(i);
    };
    const bool          many_equal = !model.depends_on_node() && EqualFamilies<dim>::are_many(families);
    EqualFamilies<dim>  equal(families);
    CalibratedStretches result;
    result.near.assign(bonds.n_slots(), 0.);
    result.far = result.near;
    if (how.law.softens())
      result.first_near = result.first_far = result.near;
    BondCursor                   cursor(bonds);
    std::vector<BondCursor::End> ends;
    FamilyView<dim>              family;
    // Of the different families, in the order of their numbers; of the last one where all may differ.
    std::vector<Known<dim>> known;
    std::vector<LocalIndex> codes;
    // Number of families, and sums of their shares.
    std::array<double, 4>      sums       = {};
    dealii::types::material_id material   = dealii::numbers::invalid_material_id;
    bool                       has_images = false;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        // The cursor goes from family to family.
        cursor.find(i, families.begin(i), families.end(i), ends);
        if (!families.is_whole(i) || !(how.fracture_of(families.material[i]).energy > 0))
          continue;
        family.reinit(families, i);
        if (families.material[i] != material)
          {
            material                      = families.material[i];
            const ElasticSolid<dim> solid = solid_of(material);
            family.set_solid(solid);
            has_images = !model.depends_on_node() && is_isotropic(solid, how.fracture_of(material));
          }
        typename EqualFamilies<dim>::Match match{0, true};
        if (many_equal)
          match = equal.find(family, material, codes);
        else
          known.clear();
        if (match.is_new)
          known.push_back({family, {}, codes.empty() ? 0 : codes.front()});
        Known<dim> &own = known[match.number];
        if (!own.is_calibrated && (is_wanted(i) || (many_equal && match.number < n_at_once)))
          {
            own.made          = recall(own.first, model, how, material, has_images, !many_equal);
            own.is_calibrated = true;
          }
        else if (match.is_new)
          own.made = least_of(family, how, material);
        result.are_all_known = result.are_all_known && own.is_calibrated;
        for (LocalIndex k = 0; k < family.size; ++k)
          {
            const BondCursor::End &end = ends[family.member[k]];
            (end.is_near ? result.near : result.far)[end.slot] =
              own.made.squares[many_equal ? codes[k] - own.first_code : k];
            if (how.law.softens())
              (end.is_near ? result.first_near : result.first_far)[end.slot] = own.made.first;
          }
        const std::array<double, 4> more = {
          {1., own.made.shares.mean, own.made.shares.smallest, own.made.shares.largest}};
        for (unsigned int m = 0; m < more.size(); ++m)
          sums[m] += more[m];
      }
    exchange_cut_bonds(families, bonds, {result.near.data()}, {result.far.data()});
    if (how.law.softens())
      exchange_cut_bonds(families, bonds, {result.first_near.data()}, {result.first_far.data()});
    result.are_all_known =
      dealii::Utilities::MPI::min(result.are_all_known ? 1u : 0u, families.communicator) == 1;
    for (double &sum : sums)
      sum = dealii::Utilities::MPI::sum(sum, families.communicator);
    if (sums[0] > 0)
      result.shares = {sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]};
    return result;
  }

  PERIDEAL_INSTANTIATE(calibrate_stretches)
} // namespace perideal
