// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/paraview_state.h>
#include <perideal/output/vtu_text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace perideal
{
  namespace
  {
    /// The objects of a state; ParaView numbers its own ones from below.
    enum StateObject
    {
      reader = 1001,
      warp,
      colours,
      body,
      colour_bar,
      view
    };

    /// Where an object lives: with the data, or with what draws.
    constexpr unsigned int with_data = 1, with_view = 21;

    /// Half of the angle that a view of ParaView sees, 30 degrees.
    constexpr double half_angle = 15 * dealii::numbers::PI / 180;

    /// Points of a map of colours: value, red, green, blue.
    using Map = std::vector<std::array<double, 4>>;

    const Map light_to_red   = {{{0., 1., .961, .941}}, {{.5, .984, .416, .29}}, {{1., .404, 0., .051}}};
    const Map blue_to_yellow = {{{0., .267, .005, .329}},
                                {{.25, .229, .322, .545}},
                                {{.5, .128, .567, .551}},
                                {{.75, .369, .789, .383}},
                                {{1., .993, .906, .144}}};

    /// Writes the XML of a state.
    class StateWriter
    {
    public:
      StateWriter() { text.precision(8); }

      void open(const std::string &group,
                const std::string &type,
                const StateObject  object,
                const unsigned int where)
      {
        current = object;
        text << "    <Proxy group=\"" << group << "\" type=\"" << type << "\" id=\"" << object
             << "\" servers=\"" << where << "\">\n";
      }

      void close() { text << "    </Proxy>\n"; }

      template <typename T>
      void property(const std::string &name, const std::vector<T> &values)
      {
        head(name, values.size());
        for (std::size_t k = 0; k < values.size(); ++k)
          text << "        <Element index=\"" << k << "\" value=\"" << values[k] << "\"/>\n";
        text << "      </Property>\n";
      }

      void vector(const std::string &name, const dealii::Tensor<1, 3> &value)
      {
        property<double>(name, {value[0], value[1], value[2]});
      }

      /// Selects an array of points (0) or cells (1) by its name.
      void array(const std::string &name, const std::string &association, const std::string &selected)
      {
        property<std::string>(name, {"", "", "", association, selected});
      }

      /// Refers to other objects, to their data or to themselves.
      void refer(const std::string &name, const std::vector<StateObject> &others, const bool to_data = false)
      {
        head(name, others.size());
        for (const StateObject other : others)
          text << "        <Proxy value=\"" << other << '"' << (to_data ? " output_port=\"0\"" : "")
               << "/>\n";
        text << "      </Property>\n";
      }

      void collection(const std::string &name, const StateObject object, const std::string &called)
      {
        text << "    <ProxyCollection name=\"" << name << "\">\n      <Item id=\"" << object << "\" name=\""
             << called << "\"/>\n    </ProxyCollection>\n";
      }

      std::string finish() const
      {
        return "<ParaView>\n  <ServerManagerState version=\"5.9.0\">\n" + text.str() +
               "  </ServerManagerState>\n</ParaView>\n";
      }

    private:
      void head(const std::string &name, const std::size_t n)
      {
        text << "      <Property name=\"" << name << "\" id=\"" << current << '.' << name
             << "\" number_of_elements=\"" << n << "\">\n";
      }

      std::ostringstream text;
      StateObject        current = reader;
    };

    const VtuArray *find(const std::vector<VtuArray> &arrays, const std::string &name)
    {
      const auto found =
        std::find_if(arrays.begin(), arrays.end(), [&](const VtuArray &array) { return array.name == name; });
      return found == arrays.end() ? nullptr : &*found;
    }

    /// The factor that makes displacements visible on a body, 1 where they are anyway.
    double visible_magnification(const double largest, const double diagonal)
    {
      if (!(largest > 0) || largest > .02 * diagonal)
        return 1;
      const double wanted = .06 * diagonal / largest;
      const double power  = std::pow(10., std::floor(std::log10(wanted)));
      return (wanted >= 5 * power ? 5 : wanted >= 2 * power ? 2 : 1) * power;
    }

    void write_colours(const ParaViewState &state, StateWriter &out)
    {
      std::vector<double> points;
      for (const auto &point : state.is_share ? light_to_red : blue_to_yellow)
        points.insert(points.end(), point.begin(), point.end());
      out.open("lookup_tables", "PVLookupTable", colours, with_view);
      out.property("RGBPoints", points);
      // Damage lies from 0 to 1; the range of all else follows the steps.
      out.property<int>("AutomaticRescaleRangeMode", {state.is_share ? -1 : 1});
      out.property<int>("ScalarRangeInitialized", {state.is_share ? 1 : 0});
      out.close();
      out.open("representations", "ScalarBarWidgetRepresentation", colour_bar, with_view);
      out.property<int>("Enabled", {1});
      out.property<int>("Visibility", {1});
      out.refer("LookupTable", {colours});
      out.property<std::string>("Title", {state.field});
      out.property<std::string>("ComponentTitle", {state.of_cells ? "" : "Magnitude"});
      out.close();
    }

    void write_view(const ParaViewState &state, StateWriter &out)
    {
      const bool                 plane  = state.dimension == 2;
      const dealii::Tensor<1, 3> middle = .5 * (state.lower + state.upper);
      const double radius = .5 * (state.upper - state.lower).norm() * (state.magnification > 0 ? 1.1 : 1);
      dealii::Tensor<1, 3> towards, up;
      towards[2] = 1;
      up[1]      = 1;
      if (!plane)
        {
          towards = dealii::Point<3>(1, -2, 1) / std::sqrt(6.);
          up      = dealii::Point<3>(0, 0, 1);
        }
      out.open("views", "RenderView", view, with_view);
      out.refer("Representations", {body, colour_bar});
      out.property<int>("CameraParallelProjection", {plane ? 1 : 0});
      out.property<double>("CameraParallelScale", {radius});
      out.vector("CameraFocalPoint", middle);
      out.vector("CameraPosition", middle + radius / std::sin(half_angle) * towards);
      out.vector("CameraViewUp", up);
      out.vector("CenterOfRotation", middle);
      out.close();
    }
  } // namespace

  ParaViewState choose_state(const VtuPiece &part, MPI_Comm communicator)
  {
    ParaViewState state;
    state.dimension = part.dimension;
    // Largest of the displacement's square, then of the coordinates, then of their negatives.
    std::vector<double> largest(7, std::numeric_limits<double>::lowest());
    for (std::size_t k = 0; k < part.points.size(); ++k)
      {
        largest[1 + k % 3] = std::max<double>(largest[1 + k % 3], part.points[k]);
        largest[4 + k % 3] = std::max<double>(largest[4 + k % 3], -part.points[k]);
      }
    const VtuArray *displacement = find(part.point_data, "displacement");
    if (displacement != nullptr)
      for (std::size_t k = 0; k + 2 < displacement->values.size(); k += 3)
        {
          const float *u = &displacement->values[k];
          largest[0]     = std::max<double>(largest[0], u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        }
    const std::vector<double> mine = largest;
    dealii::Utilities::MPI::max(mine, communicator, largest);
    for (unsigned int d = 0; d < 3; ++d)
      {
        state.upper[d] = largest[1 + d];
        state.lower[d] = -largest[4 + d];
      }
    if (displacement != nullptr)
      state.magnification =
        visible_magnification(std::sqrt(std::max(0., largest[0])), (state.upper - state.lower).norm());

    const auto scalar = std::find_if(part.cell_data.begin(), part.cell_data.end(), [](const VtuArray &array) {
      return array.n_components == 1;
    });
    if (find(part.cell_data, "damage") != nullptr)
      {
        state.field    = "damage";
        state.is_share = true;
      }
    else if (scalar != part.cell_data.end())
      state.field = scalar->name;
    else
      {
        state.of_cells = displacement == nullptr;
        state.field    = displacement != nullptr ? "displacement" :
                         part.cell_data.empty()  ? "" :
                                                   part.cell_data[0].name;
      }
    return state;
  }

  std::string state_text(const ParaViewState &state)
  {
    const bool        warped = state.magnification > 0;
    StateWriter       out;
    const StateObject shown = warped ? warp : reader;
    out.open("sources", "PVDReader", reader, with_data);
    out.property<std::string>("FileName", {"solution.pvd"});
    out.close();
    if (warped)
      {
        out.open("filters", "WarpVector", warp, with_data);
        out.refer("Input", {reader}, true);
        out.property<double>("ScaleFactor", {state.magnification});
        out.array("SelectInputVectors", "0", "displacement");
        out.close();
      }
    write_colours(state, out);
    out.open("representations", "UnstructuredGridRepresentation", body, with_view);
    out.refer("Input", {shown}, true);
    out.property<int>("Visibility", {1});
    out.property<std::string>("Representation", {"Surface"});
    if (!state.field.empty())
      {
        out.array("ColorArrayName", state.of_cells ? "1" : "0", state.field);
        out.refer("LookupTable", {colours});
      }
    out.close();
    write_view(state, out);

    out.collection("sources", reader, "solution.pvd");
    if (warped)
      out.collection("sources", warp, "deformed");
    out.collection("lookup_tables", colours, state.field + ".PVLookupTable");
    out.collection("representations", body, "body");
    out.collection("scalar_bars", colour_bar, "colours");
    out.collection("views", view, "RenderView1");
    return out.finish();
  }
} // namespace perideal
