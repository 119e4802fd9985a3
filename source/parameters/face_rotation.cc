// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/parameters/face_rotation.h>
#include <perideal/parameters/point_text.h>
#include <perideal/parameters/space_time_function.h>

#include <deal.II/base/tensor.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace perideal
{
  namespace
  {
    std::string number_of(const double value)
    {
      std::ostringstream text;
      text << '(' << std::setprecision(std::numeric_limits<double>::max_digits10) << value << ')';
      return text.str();
    }

    template <int dim>
    dealii::Tensor<1, 3> axis_of_rotation(const RotationText &rotation, const std::string &section)
    {
      dealii::Tensor<1, 3> result;
      if (dim == 2)
        {
          if (!rotation.direction.empty())
            throw InputError("in two dimensions the axis stands upright on the plane")
              .parameter(section + "Axis direction")
              .allowed("none in 2-D");
          result[2] = 1.;
          return result;
        }
      if (rotation.direction.empty())
        throw InputError("the rotation has no axis").parameter(section + "Axis direction").allowed("x, y, z");
      const dealii::Point<dim> given = read_point<dim>(rotation.direction, section + "Axis direction");
      if (given.norm() == 0.)
        throw InputError("the axis of the rotation has no direction")
          .parameter(section + "Axis direction")
          .allowed("a vector other than 0");
      for (int d = 0; d < dim; ++d)
        result[d] = given[d] / given.norm();
      return result;
    }
  } // namespace

  template <int dim>
  std::array<std::string, 3> displacement_of_rotation(const RotationText &rotation,
                                                      const bool          is_small,
                                                      const std::string  &section,
                                                      const Tables       &tables)
  {
    if (rotation.angle.empty())
      throw InputError("an axis is given, and no angle")
        .parameter(section + "Rotation")
        .allowed("an angle [rad], such as 0.1*t");
    // A mistake in the formula is told of it, and not of those made of it.
    SpaceTimeFunction<dim>(rotation.angle, section + "Rotation", tables);
    if (rotation.point.empty())
      throw InputError("the rotation has no axis")
        .parameter(section + "Axis point")
        .allowed("coordinates of a point of the axis [m], separated by commas");
    const dealii::Point<dim>   point = read_point<dim>(rotation.point, section + "Axis point");
    const dealii::Tensor<1, 3> k     = axis_of_rotation<dim>(rotation, section);

    const char                *axes[] = {"x", "y", "z"};
    std::array<std::string, 3> arm    = {{"0", "0", "0"}}, result;
    for (int d = 0; d < dim; ++d)
      arm[d] = std::string("(") + axes[d] + "-" + number_of(point[d]) + ")";
    const std::string angle = "(" + rotation.angle + ")";
    for (int d = 0; d < dim; ++d)
      {
        // k x r and k x (k x r) = k (k.r) - r.
        const int         b = (d + 1) % 3, c = (d + 2) % 3;
        const std::string once =
          "(" + number_of(k[b]) + "*" + arm[c] + "-" + number_of(k[c]) + "*" + arm[b] + ")";
        std::string along = "0";
        for (int e = 0; e < dim; ++e)
          along += "+" + number_of(k[d] * k[e]) + "*" + arm[e];
        const std::string twice = "(" + along + "-" + arm[d] + ")";
        result[d] =
          is_small ? angle + "*" + once : "sin" + angle + "*" + once + "+(1-cos" + angle + ")*" + twice;
      }
    return result;
  }

  template std::array<std::string, 3>
  displacement_of_rotation<2>(const RotationText &, const bool, const std::string &, const Tables &);
  template std::array<std::string, 3>
  displacement_of_rotation<3>(const RotationText &, const bool, const std::string &, const Tables &);
} // namespace perideal
