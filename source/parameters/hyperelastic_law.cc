// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/parameters/hyperelastic_law.h>

#include <deal.II/physics/elasticity/kinematics.h>
#include <deal.II/physics/elasticity/standard_tensors.h>

#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::symmetrize;
    using dealii::Tensor;
    using dealii::unit_symmetric_tensor;
    namespace Kinematics = dealii::Physics::Elasticity::Kinematics;

    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

    /// A symmetric tensor of the problem's own dimension in space, nothing across.
    template <int dim>
    SymmetricTensor<2, 3> in_space(const SymmetricTensor<2, dim> &tensor)
    {
      SymmetricTensor<2, 3> result;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          result[i][j] = tensor[i][j];
      return result;
    }

    /// W = eps:C:eps/2 of the small strain eps = sym H.
    template <int dim>
    class LinearElastic : public HyperelasticLaw<dim>
    {
    public:
      explicit LinearElastic(const ElasticSolid<dim> &solid)
        : solid(solid)
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, dim> strain = symmetrize(H);
        return 0.5 * (strain * (solid.stiffness() * strain));
      }
      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        return solid.stiffness() * symmetrize(H);
      }
      Tensor<4, dim>        tangent(const Tensor<2, dim> &) const override { return solid.stiffness(); }
      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        return solid.stiffness_in_space() * solid.strain_in_space(symmetrize(H));
      }
      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        return dim == 3 ? 1. : std::max(0., 1. + solid.strain_in_space(symmetrize(H))[2][2]);
      }
      bool is_linear() const override { return true; }

    private:
      const ElasticSolid<dim> solid;
    };

    /**
     * W = E:C:E/2 of the Green strain E = (F^T F - I)/2. In plane stress S_33 = 0 gives E_33 in closed form,
     * and C of the plane is what that leaves. Nothing in W keeps the thickness, sqrt(1 + 2 E_33), from
     * vanishing in a body that is pulled far, nor the material from being pressed through itself.
     */
    template <int dim>
    class SaintVenantKirchhoff : public HyperelasticLaw<dim>
    {
    public:
      explicit SaintVenantKirchhoff(const ElasticSolid<dim> &solid)
        : solid(solid)
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, dim> strain = green_strain(H);
        return 0.5 * (strain * (solid.stiffness() * strain));
      }

      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        return Kinematics::F(H) * Tensor<2, dim>(solid.stiffness() * green_strain(H));
      }

      /// delta_ik S_JL + F_iK C_KJML F_kM
      Tensor<4, dim> tangent(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim>          F = Kinematics::F(H);
        const SymmetricTensor<2, dim> S = solid.stiffness() * green_strain(H);
        const Tensor<4, dim>          C = solid.stiffness();
        // C_KJML F_kM, then F_iK of that.
        Tensor<4, dim> result;
        for (int i = 0; i < dim; ++i)
          for (int J = 0; J < dim; ++J)
            for (int k = 0; k < dim; ++k)
              for (int L = 0; L < dim; ++L)
                {
                  double sum = i == k ? S[J][L] : 0.;
                  for (int K = 0; K < dim; ++K)
                    for (int M = 0; M < dim; ++M)
                      sum += F[i][K] * C[K][J][M][L] * F[k][M];
                  result[i][J][k][L] = sum;
                }
        return result;
      }

      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        const SymmetricTensor<2, 3> strain = solid.strain_in_space(green_strain(H));
        Tensor<2, 3>                F      = Tensor<2, 3>(in_space(SymmetricTensor<2, dim>()));
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            F[i][j] = H[i][j] + (i == j ? 1. : 0.);
        if (dim == 2)
          F[2][2] = thickness_stretch(H);
        const Tensor<2, 3> S = solid.stiffness_in_space() * strain;
        return symmetrize(F * S * transpose(F)) / determinant(F);
      }

      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        return dim == 3 ? 1. :
                          std::sqrt(std::max(0., 1. + 2. * solid.strain_in_space(green_strain(H))[2][2]));
      }

    private:
      static SymmetricTensor<2, dim> green_strain(const Tensor<2, dim> &H)
      {
        return symmetrize(H + 0.5 * transpose(H) * H);
      }

      const ElasticSolid<dim> solid;
    };

    /**
     * W = mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2 in space. In plane stress the stretch t across is
     * where P_33 = mu (t - 1/t) + lambda ln(J)/t vanishes.
     */
    template <int dim>
    class NeoHookean : public HyperelasticLaw<dim>
    {
    public:
      explicit NeoHookean(const ElasticConstants &constants)
        : assumption(constants.assumption)
        , mu(constants.shear_modulus())
        , lambda(ElasticConstants{constants.young_modulus, constants.poisson_ratio, PlaneAssumption::solid}
                   .lame_lambda())
      {
      }

      double energy(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> F = Kinematics::F(H);
        const double         t = thickness_stretch(H), log_J = std::log(determinant(F) * t);
        if (!std::isfinite(log_J))
          return std::numeric_limits<double>::infinity();
        const double across = dim == 2 ? t * t : 0.;
        return 0.5 * mu * (F.norm_square() + across - 3.) - mu * log_J + 0.5 * lambda * log_J * log_J;
      }

      Tensor<2, dim> stress(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> F = Kinematics::F(H), G = transpose(invert(F));
        return mu * F + (lambda * log_of_volume(H) - mu) * G;
      }

      /// mu delta_ik delta_JL + (mu - lambda ln J) G_iL G_kJ + lambda' G_iJ G_kL with G = F^-T. In plane
      /// stress lambda' is lambda less what the change of the thickness takes.
      Tensor<4, dim> tangent(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim> G      = transpose(invert(Kinematics::F(H)));
        const double         log_J  = log_of_volume(H);
        double               second = lambda;
        if (is_plane_stress())
          {
            const double t = thickness_stretch(H);
            second -= lambda * lambda / (mu * (t * t + 1.) + lambda * (1. - log_J));
          }
        Tensor<4, dim> result;
        for (int i = 0; i < dim; ++i)
          for (int J = 0; J < dim; ++J)
            for (int k = 0; k < dim; ++k)
              for (int L = 0; L < dim; ++L)
                result[i][J][k][L] = (i == k && J == L ? mu : 0.) +
                                     (mu - lambda * log_J) * G[i][L] * G[k][J] + second * G[i][J] * G[k][L];
        return result;
      }

      SymmetricTensor<2, 3> cauchy_stress(const Tensor<2, dim> &H) const override
      {
        const Tensor<2, dim>  F = Kinematics::F(H);
        const double          t = thickness_stretch(H), J = determinant(F) * t;
        SymmetricTensor<2, 3> result = in_space<dim>(symmetrize(stress(H) * transpose(F)) / J);
        if (dim == 2)
          result[2][2] = (mu * (t * t - 1.) + lambda * std::log(J)) / J;
        return result;
      }

      /// NaN where the body is pressed through itself.
      double thickness_stretch(const Tensor<2, dim> &H) const override
      {
        if (!is_plane_stress())
          return 1.;
        const double log_area = std::log(determinant(Kinematics::F(H)));
        // mu (exp(2s) - 1) + lambda (log_area + s) = 0, by Newton's method from what small strains give.
        double s = -lambda * log_area / (2. * mu + lambda);
        for (unsigned int k = 0; k < 50 && std::isfinite(s); ++k)
          {
            const double square = std::exp(2. * s), change = (mu * (square - 1.) + lambda * (log_area + s)) /
                                                             (2. * mu * square + lambda);
            s -= change;
            if (std::abs(change) < 1e-14)
              return std::exp(s);
          }
        return no_number;
      }

    private:
      bool is_plane_stress() const { return dim == 2 && assumption == PlaneAssumption::plane_stress; }

      double log_of_volume(const Tensor<2, dim> &H) const
      {
        return std::log(determinant(Kinematics::F(H)) * thickness_stretch(H));
      }

      const PlaneAssumption assumption;
      const double          mu, lambda;
    };

    template <int dim>
    using Factory = std::shared_ptr<const HyperelasticLaw<dim>> (*)(const ElasticSolid<dim> &);

    /// The list of laws: a new one is one class and one line here.
    template <int dim>
    const Registry<Factory<dim>> &laws()
    {
      static const Registry<Factory<dim>> list(
        "Material/Law",
        {{"linear elastic",
          [](const ElasticSolid<dim> &solid) -> std::shared_ptr<const HyperelasticLaw<dim>> {
            return std::make_shared<LinearElastic<dim>>(solid);
          }},
         {"Saint Venant-Kirchhoff",
          [](const ElasticSolid<dim> &solid) -> std::shared_ptr<const HyperelasticLaw<dim>> {
            return std::make_shared<SaintVenantKirchhoff<dim>>(solid);
          }},
         {"neo-Hookean", [](const ElasticSolid<dim> &solid) -> std::shared_ptr<const HyperelasticLaw<dim>> {
            return std::make_shared<NeoHookean<dim>>(solid.isotropic());
          }}});
      return list;
    }
  } // namespace

  std::vector<std::string> law_names()
  {
    return laws<2>().names();
  }

  bool takes_any_symmetry(const std::string &law)
  {
    return law != "neo-Hookean";
  }

  template <int dim>
  std::shared_ptr<const HyperelasticLaw<dim>> create_law(const std::string       &name,
                                                         const ElasticSolid<dim> &solid)
  {
    if (!solid.is_isotropic() && !takes_any_symmetry(name))
      throw InputError("this law is one of isotropic materials")
        .parameter("Material/Law")
        .given(name)
        .allowed("linear elastic | Saint Venant-Kirchhoff for this symmetry");
    return laws<dim>().get(name)(solid);
  }

  PERIDEAL_INSTANTIATE(create_law)
} // namespace perideal
