// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/contact_force.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <functional>

using namespace perideal;

namespace
{
  constexpr double horizon_factor = 2.2;

  /// A bond-based body of modulus 1 cut through where x = 0.5, with contact.
  template <int dim>
  struct CutBody
  {
    explicit CutBody(const Mesh<dim> &mesh, const ContactParameters &contact_parameters = {})
      : body(mesh, horizon_factor)
    {
      ModelParameters parameters;
      parameters.model = "bond based";
      parameters.form  = "energy";
      parameters.resolve(dim);
      const ElasticConstants constants{
        1., 0.25, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain};
      bonds = create_bond_force<dim>(*weigh_bonds<dim>(
        body.families, *create_model<dim>(parameters, 1.), [&](const dealii::types::material_id) {
          return ElasticSolid<dim>(constants);
        }));
      bonds->cut([](const dealii::Point<dim> &a, const dealii::Point<dim> &b) {
        return (a[0] < 0.5) != (b[0] < 0.5);
      });
      contact = std::make_unique<ContactForce<dim>>(
        body.families,
        contact_parameters,
        horizon_factor,
        [](const dealii::types::material_id) { return 1.; },
        std::vector<bool>(body.nodes.size(), true));
      bonds->initialize(force);
      bonds->initialize(displacement);
    }

    /// Contact forces of a displacement.
    const NodalVector &force_of(const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &u)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) = u(body.nodes.position[i])[d];
      return force_of_displacement();
    }

    const NodalVector &force_of_displacement()
    {
      bonds->compute(force, displacement);
      force = 0.;
      contact->add(force, *bonds);
      return force;
    }

    test::Body<dim>                    body;
    std::unique_ptr<BondForce<dim>>    bonds;
    std::unique_ptr<ContactForce<dim>> contact;
    NodalVector                        force, displacement;
  };

  /// Every pair of all ranks without a bond, one by one: forces by global number.
  template <int dim>
  std::vector<double>
  forces_by_definition(const CutBody<dim> &cut, const ContactParameters &parameters, double &energy)
  {
    // Position at rest, present position, volume, spacing.
    std::vector<std::array<double, 2 * dim + 2>> own(cut.body.nodes.size());
    for (LocalIndex i = 0; i < own.size(); ++i)
      {
        for (int d = 0; d < dim; ++d)
          {
            own[i][d]       = cut.body.nodes.position[i][d];
            own[i][dim + d] = own[i][d] + cut.displacement.local_element(dim * i + d);
          }
        own[i][2 * dim]     = cut.body.nodes.volume[i];
        own[i][2 * dim + 1] = cut.body.nodes.spacing[i];
      }
    std::vector<double> flat;
    for (const auto &node : own)
      flat.insert(flat.end(), node.begin(), node.end());
    std::vector<std::vector<double>> nodes;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, flat))
      for (auto at = of_rank.begin(); at != of_rank.end(); at += 2 * dim + 2)
        nodes.emplace_back(at, at + 2 * dim + 2);

    std::vector<double> result(dim * nodes.size(), 0.);
    energy = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j)
        {
          const auto  &a = nodes[i], &b = nodes[j];
          const double mean = 0.5 * (a[2 * dim + 1] + b[2 * dim + 1]);
          double       rest = 0, length = 0;
          for (int d = 0; d < dim; ++d)
            {
              rest += (b[d] - a[d]) * (b[d] - a[d]);
              length += (b[dim + d] - a[dim + d]) * (b[dim + d] - a[dim + d]);
            }
          rest                 = std::sqrt(rest);
          length               = std::sqrt(length);
          const double horizon = horizon_factor * std::max(a[2 * dim + 1], b[2 * dim + 1]);
          if (rest <= horizon && (a[0] < 0.5) == (b[0] < 0.5)) // bonded
            continue;
          const double reach = parameters.distance * std::min(mean, rest);
          if (length >= reach)
            continue;
          const auto stiffness = [&](const std::vector<double> &node) {
            return parameters.stiffness * node[2 * dim] / std::pow(horizon_factor * node[2 * dim + 1], 2);
          };
          const double k = std::min(stiffness(a), stiffness(b));
          energy += 0.5 * k * (reach - length) * (reach - length);
          for (int d = 0; d < dim; ++d)
            {
              const double push = k * (reach - length) * (b[dim + d] - a[dim + d]) / length;
              result[dim * i + d] -= push;
              result[dim * j + d] += push;
            }
        }
    return result;
  }

  /// Forces and energy are those of the definition.
  template <int dim>
  void
  expect_definition(CutBody<dim> &cut, const ContactParameters &parameters, const unsigned int least_pairs)
  {
    double     energy;
    const auto expected = forces_by_definition(cut, parameters, energy);
    ASSERT_GE(cut.contact->n_contacts(), least_pairs);
    ASSERT_GT(energy, 0.);
    // Distances at rest are shortened by 1e-12.
    EXPECT_NEAR(cut.contact->energy(), energy, 1e-10 * energy);
    double scale = 0;
    for (const double f : expected)
      scale = std::max(scale, std::abs(f));
    for (LocalIndex i = 0; i < cut.body.nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        ASSERT_NEAR(cut.force.local_element(dim * i + d),
                    expected[dim * (cut.body.nodes.first_global + i) + d],
                    1e-10 * scale);
    // Equal and opposite.
    for (int d = 0; d < dim; ++d)
      {
        double sum = 0;
        for (LocalIndex i = 0; i < cut.body.nodes.size(); ++i)
          sum += cut.force.local_element(dim * i + d);
        EXPECT_LE(std::abs(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD)), 1e-12 * scale);
      }
  }

  template <int dim>
  void expect_contacts()
  {
    using Displacement = dealii::Tensor<1, dim>;
    for (const auto &mesh : test::make_boxes<dim>())
      for (const double distance : {0.9, 1.})
        {
          ContactParameters parameters;
          parameters.distance  = distance;
          parameters.stiffness = 2.;
          CutBody<dim> cut(*mesh, parameters);

          // At rest nothing repels, nor does what is torn apart.
          const auto halves = [](const double right) {
            return [=](const dealii::Point<dim> &x) {
              Displacement u;
              u[0] = x[0] < 0.5 ? 0. : right;
              return u;
            };
          };
          EXPECT_EQ(cut.force_of(halves(0.)).linfty_norm(), 0.);
          EXPECT_EQ(cut.force_of(halves(0.3)).linfty_norm(), 0.);
          EXPECT_EQ(cut.contact->energy(), 0.);

          // Pressed: nodes that were bonded.
          cut.force_of(halves(-0.08));
          expect_definition(cut, parameters, 3);

          // Half a body that is carried elsewhere and turned over meets strangers, in small moves and in a
          // jump.
          CutBody<dim> jumped(*mesh, parameters);
          const auto   turned = [](const double angle) {
            return [=](const dealii::Point<dim> &x) {
              Displacement u;
              if (x[0] >= 0.5)
                {
                  const double r = x[0] - 0.5, s = x[1] - 0.4;
                  u[0] = r * std::cos(angle) - s * std::sin(angle) + 0.5 - x[0];
                  u[1] = r * std::sin(angle) + s * std::cos(angle) + 0.4 - x[1] - 0.02 * angle;
                }
              return u;
            };
          };
          for (unsigned int step = 0; step <= 200; ++step)
            cut.force_of(turned(0.01 * step));
          expect_definition(cut, parameters, 2);
          EXPECT_GE(cut.contact->n_searches(), 1u);
          EXPECT_LE(cut.contact->n_searches(), 50u); // not every time
          const NodalVector in_small_moves = cut.force;
          for (LocalIndex i = 0; i < in_small_moves.locally_owned_size(); ++i)
            jumped.displacement.local_element(i) = cut.displacement.local_element(i);
          jumped.force_of_displacement();
          jumped.force -= in_small_moves;
          EXPECT_LE(jumped.force.linfty_norm(), 1e-13 * in_small_moves.linfty_norm());
        }
  }
} // namespace

TEST(ContactForce, PushesApartWhatHasNoBond)
{
  expect_contacts<2>();
  expect_contacts<3>();
}

/// The force is the gradient of the energy.
TEST(ContactForce, FollowsItsEnergy)
{
  const auto mesh = test::make_box<2>({8, 7}, {1., 1.}, 0.2);
  CutBody<2> cut(*mesh);
  const auto at = [&](const double step) {
    return [=](const dealii::Point<2> &x) {
      dealii::Tensor<1, 2> u;
      u[0] = x[0] < 0.5 ? 0. : -0.1;
      for (int d = 0; d < 2; ++d)
        u[d] += (0.01 + step) * test::scatter(x, 3 + d);
      return u;
    };
  };
  const double h = 1e-6;
  cut.force_of(at(-h));
  const double before = cut.contact->energy();
  cut.force_of(at(h));
  const double after = cut.contact->energy();
  cut.force_of(at(0.));
  double power = 0;
  for (LocalIndex i = 0; i < cut.body.nodes.size(); ++i)
    for (int d = 0; d < 2; ++d)
      power += cut.force.local_element(2 * i + d) * test::scatter(cut.body.nodes.position[i], 3 + d);
  power = dealii::Utilities::MPI::sum(power, MPI_COMM_WORLD);
  ASSERT_GT(cut.contact->n_contacts(), 3u);
  EXPECT_NEAR((after - before) / (2 * h), -power, 1e-6 * std::abs(power));
}

/// What cannot come into contact is left out of the search: inner nodes that lost no bond.
TEST(ContactForce, SearchesTheSurfaceAlone)
{
  const auto mesh = test::make_box<2>({20, 20}, {1., 1.}, 0.);
  CutBody<2> cut(*mesh);
  cut.contact = std::make_unique<ContactForce<2>>(
    cut.body.families,
    ContactParameters(),
    horizon_factor,
    [](const dealii::types::material_id) { return 1.; },
    std::vector<bool>(cut.body.nodes.size(), false));
  const auto far = [](const dealii::Point<2> &x) {
    return dealii::Tensor<1, 2>(dealii::Point<2>(x[0] < 0.5 ? 0. : -0.03, x[0] < 0.5 ? 0. : 0.3));
  };
  cut.force_of(far);
  EXPECT_EQ(cut.contact->n_searches(), 1u);
  // Two columns of nodes on either side of the cut lost bonds: 80 of 400.
  EXPECT_EQ(cut.contact->n_left_out(), 320u);
  // Those of the face meet one another as all nodes would.
  const NodalVector few = cut.force;
  CutBody<2>        all(*mesh);
  all.force_of(far);
  ASSERT_GT(all.force.linfty_norm(), 0.);
  all.force -= few;
  EXPECT_LE(all.force.linfty_norm(), 1e-13 * few.linfty_norm());
}

/// Halves of cells that were nearer than halves may come begin unpushed, whether they meet what they were
/// bonded to or strangers, and are pushed as soon as they come nearer still.
TEST(ContactForce, HalvesBeginUnpushed)
{
  const auto mesh   = test::make_box<2>({20, 20}, {1., 1.}, 0.1);
  const auto closer = [](const double gap, const double slip) {
    return [=](const dealii::Point<2> &x) {
      return dealii::Tensor<1, 2>(dealii::Point<2>(x[0] < 0.5 ? 0. : -gap, x[0] < 0.5 ? 0. : slip));
    };
  };
  for (const double slip : {0., 0.31})
    for (const double side : {0.5, 1.1}) // halves on one side, on both
      {
        CutBody<2> cut(*mesh);
        cut.force_of(closer(0.02, slip));
        const double pushed = cut.contact->energy();
        ASSERT_GT(pushed, 0.);
        LastingState state;
        cut.contact->register_state(state);
        Checkpoint checkpoint;
        state.save(checkpoint);
        auto &values = checkpoint.node_arrays.at("reach of contact").values;
        for (LocalIndex i = 0; i < cut.body.nodes.size(); ++i)
          {
            EXPECT_DOUBLE_EQ(values[2 * i + 1], 1.);
            values[2 * i] = cut.body.nodes.position[i][0] < side ? 1. : 0.;
          }
        state.resume(checkpoint);
        cut.force_of(closer(0.02, slip));
        EXPECT_LE(cut.contact->energy(), 1e-20 * pushed) << slip << ' ' << side;
        cut.force_of(closer(0.021, slip));
        EXPECT_GT(cut.contact->energy(), 0.);
        // What goes on from here knows it; nobody is a half any more.
        state.save(checkpoint);
        state.resume(checkpoint);
        cut.force_of(closer(0.02, slip));
        EXPECT_LE(cut.contact->energy(), 1e-20 * pushed);
        double least = 1.;
        for (LocalIndex i = 0; i < cut.body.nodes.size(); ++i)
          {
            EXPECT_EQ(values[2 * i], 0.);
            least = std::min(least, values[2 * i + 1]);
            if (!(cut.body.nodes.position[i][0] < side))
              {
                EXPECT_EQ(values[2 * i + 1], 1.);
              }
          }
        EXPECT_LT(dealii::Utilities::MPI::min(least, MPI_COMM_WORLD), 0.99);
      }
}

TEST(ContactForce, RejectsValuesOutOfRange)
{
  ContactParameters parameters;
  parameters.distance = 1.1;
  test::expect_input_error([&]() { parameters.check(); }, {"Contact/Distance", "0 < distance <= 1"});
  parameters.distance  = 0.9;
  parameters.stiffness = 0.;
  test::expect_input_error([&]() { parameters.check(); }, {"Contact/Stiffness", "allowed:"});
}
