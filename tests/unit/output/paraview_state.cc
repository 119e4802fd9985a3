// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/paraview_state.h>
#include <perideal/output/vtu_text.h>

#include "testing.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <map>
#include <sstream>

using namespace perideal;
using boost::property_tree::ptree;

namespace
{
  /// A square of 2 m that moved by 0.01 m along x.
  VtuPiece square(const std::vector<VtuArray> &cell_data)
  {
    VtuPiece piece;
    piece.points     = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    piece.corners    = {0, 1, 3, 2};
    piece.point_data = {{"displacement", 3, {0, 0, 0, .01f, 0, 0, .01f, 0, 0, 0, 0, 0}}};
    piece.cell_data  = cell_data;
    return piece;
  }

  /// The objects of a state by "group/type".
  std::map<std::string, ptree> objects(const std::string &text)
  {
    std::istringstream stream(text);
    ptree              tree;
    read_xml(stream, tree);
    std::map<std::string, ptree> result;
    for (const auto &[name, node] : tree.get_child("ParaView.ServerManagerState"))
      if (name == "Proxy")
        result[node.get<std::string>("<xmlattr>.group") + "/" + node.get<std::string>("<xmlattr>.type")] =
          node;
    return result;
  }

  /// The values of a property.
  std::vector<std::string> property(const ptree &object, const std::string &name)
  {
    std::vector<std::string> result;
    for (const auto &[kind, node] : object)
      if (kind == "Property" && node.get<std::string>("<xmlattr>.name") == name)
        {
          for (const auto &[what, value] : node)
            if (what == "Element" || what == "Proxy")
              result.push_back(value.get<std::string>("<xmlattr>.value"));
          EXPECT_EQ(node.get<std::size_t>("<xmlattr>.number_of_elements"), result.size());
        }
    return result;
  }
} // namespace

TEST(ParaViewState, ChoosesWhatIsSeenBest)
{
  const auto of = [](const VtuPiece &piece) { return choose_state(piece, MPI_COMM_WORLD); };
  // 6 % of 2.83 m over 0.01 m is 17.
  const ParaViewState state =
    of(square({{"stress", 3, {1, 2, 3}}, {"von_mises_stress", 1, {5}}, {"damage", 1, {0}}}));
  EXPECT_EQ(state.field, "damage");
  EXPECT_TRUE(state.of_cells);
  EXPECT_NEAR(state.magnification, 10., 1e-12);
  EXPECT_NEAR(state.upper[0], 2., 1e-12);
  EXPECT_NEAR(state.lower[1], 0., 1e-12);
  EXPECT_EQ(of(square({{"stress", 3, {1, 2, 3}}, {"von_mises_stress", 1, {5}}})).field, "von_mises_stress");
  const ParaViewState plain = of(square({}));
  EXPECT_EQ(plain.field, "displacement");
  EXPECT_FALSE(plain.of_cells);
  VtuPiece far = square({});
  for (float &u : far.point_data[0].values)
    u *= 10;
  EXPECT_EQ(of(far).magnification, 1.) << "seen as it is";
  VtuPiece still = square({{"velocity", 3, {1, 2, 3}}});
  still.point_data.clear();
  EXPECT_EQ(of(still).magnification, 0.);
  EXPECT_EQ(of(still).field, "velocity");
}

TEST(ParaViewState, OpensTheRunWithoutADirectory)
{
  const auto all = objects(state_text(choose_state(square({{"damage", 1, {0}}}), MPI_COMM_WORLD)));
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(property(all.at("sources/PVDReader"), "FileName"), std::vector<std::string>{"solution.pvd"});
  const auto &warp = all.at("filters/WarpVector");
  EXPECT_EQ(property(warp, "ScaleFactor"), std::vector<std::string>{"10"});
  EXPECT_EQ(property(warp, "SelectInputVectors").back(), "displacement");
  const auto &body = all.at("representations/UnstructuredGridRepresentation");
  EXPECT_EQ(property(body, "ColorArrayName"), (std::vector<std::string>{"", "", "", "1", "damage"}));
  EXPECT_EQ(property(body, "Input"), std::vector<std::string>{warp.get<std::string>("<xmlattr>.id")});
  EXPECT_EQ(property(all.at("lookup_tables/PVLookupTable"), "RGBPoints").size(), 12u);
  EXPECT_EQ(property(all.at("views/RenderView"), "CameraFocalPoint"),
            (std::vector<std::string>{"1", "1", "0"}));
}
