// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_linear_model_h
#define perideal_materials_linear_model_h

#include <perideal/geometry/bond_predicate.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /// The solid of a material id.
  template <int dim>
  using SolidOf = std::function<ElasticSolid<dim>(const dealii::types::material_id)>;

  /**
   * One family as a material sees it. Arrays run over its members.
   */
  template <int dim>
  struct FamilyView
  {
    /// Number of members.
    LocalIndex size = 0;
    /// Which of the family's neighbours each is, counted from 0.
    std::vector<LocalIndex> member;
    /// Components of the bonds xi = x_j - x_i [m].
    std::array<std::vector<double>, dim> bond;
    /// |xi|^2 [m^2].
    std::vector<double> length_square;
    /// Volumes of the members V_j, as far as their bonds count them [m^3].
    std::vector<double> volume;
    /// The larger horizon of the bond's ends [m].
    std::vector<double> bond_horizon;

    /// Which owned node it is the family of.
    LocalIndex node = 0;
    /// The node's own volume [m^3] and horizon [m].
    double node_volume = 0, horizon = 0;
    /// The node's bulk modulus (of the problem's dimension) and shear modulus [Pa].
    double bulk_modulus = 0, shear_modulus = 0;
    /// The node's stiffness C [Pa]; of use to models for solids of any symmetry.
    dealii::SymmetricTensor<4, dim> stiffness;

    /// Looks at the family of owned node @p i, without those whose volume counts for nothing there; the
    /// solid is the caller's to set.
    /// @param is_gone leaves out such members; empty: all are there
    void reinit(const Families<dim>                         &families,
                const LocalIndex                             i,
                const std::function<bool(const LocalIndex)> &is_gone = {});

    /// What the node is made of.
    void set_solid(const ElasticSolid<dim> &solid);
  };

  /// How many sums over its family a model needs before it knows bond forces,
  /// and whether its forces are weighted as its sums are; or whether its bonds have
  /// tensors for stiffness, which need no sums.
  struct FamilyShape
  {
    unsigned int n_sums            = 0;
    bool         own_force_weights = false;
    bool         bond_tensors      = false;
  };

  /// What became of a family's weights.
  struct FamilyReport
  {
    /// Weights were replaced because the wanted ones do not exist or are unusable.
    bool fallback = false;
    /// A moment condition is missed: uniform strain is not met exactly.
    bool singular = false;
    /// The multipliers made a deviatoric weight negative: W may be indefinite as it stands.
    bool indefinite = false;
  };

  /**
   * The share of one family in the linear bond operator. With the bond's
   * eps = xi.(u_j - u_i), the family's sums and states are
   *
   *     s_a = sum_j sum[a]_j eps_j,     A = map s   (a, b < n_sums)
   *
   * and node i feels, and every member j opposes,
   *
   *     F = ( sum_a weight[a]_j A_a + stiffness_j eps_j ) xi_j.
   *
   * weight is force_weight where the shape has own force weights, else sum.
   *
   * With bond tensors, F = tensor_j (u_j - u_i) instead.
   */
  struct FamilyCoefficients
  {
    std::array<std::vector<double>, 2> sum;
    std::array<std::vector<double>, 2> force_weight;
    std::vector<double>                stiffness;
    /// Components of the bonds' tensors [N/m], ordered as in dealii::SymmetricTensor.
    std::array<std::vector<double>, 6> tensor;
    /// Entries (0,0), (0,1) = (1,0), (1,1) of the map.
    std::array<double, 3> map = {};
    /// c of the strain energy, [J]: half the sum of stiffness_j eps_j^2 and, without own
    /// force weights, s.A/2; with them s_0 sum_j force_weight_j eps_j + c s_0^2.
    double       energy = 0;
    FamilyReport report;

    void resize(const LocalIndex n, const FamilyShape &shape);
  };

  /// Force density on the near end of a bond xi [m] whose ends displace by eta = u' - u [m], by its own ends
  /// alone [N/m^6].
  template <int dim>
  using PairForce = std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &xi,
                                                         const dealii::Tensor<1, dim> &eta)>;

  /**
   * A small-strain peridynamic material. It knows one family at a time and
   * nothing of loops, ranks or files.
   */
  template <int dim>
  class LinearModel
  {
  public:
    virtual ~LinearModel() = default;

    virtual FamilyShape shape() const = 0;

    /// True when the operator of this model is symmetric.
    virtual bool is_symmetric() const = 0;

    /// Whether coefficients depend on which node it is, so that identical families may have others.
    virtual bool depends_on_node() const { return false; }

    /// Fills the coefficients of one family; they are resized by the caller.
    virtual void compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) = 0;

    /// Whether bond forces are those of BondOperator or of BondForce.
    enum class Kinematics
    {
      linear,
      finite
    };

    /// The force of a bond between nodes of one solid and horizon [m], in the body as it is without nodes;
    /// empty where bonds know more than their own ends.
    virtual PairForce<dim> pair_force(const ElasticSolid<dim> &, const double, const Kinematics) const
    {
      return {};
    }
  };
} // namespace perideal

#endif
