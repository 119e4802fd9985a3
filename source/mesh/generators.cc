// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/mesh/generators.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    template <int dim>
    struct Generator
    {
      void (*generate)(const MeshParameters &, CoarseMesh<dim> &);
      /// Whether the parameter Corner places its body.
      bool has_corner;
    };

    /// The list of generators.
    template <int dim>
    const Registry<Generator<dim>> &generators()
    {
      static const Registry<Generator<dim>> registry(
        "Mesh/Generator",
        {{"box", {&generate_box<dim>, true}},
         {"plate with hole", {&generate_plate_with_hole<dim>, false}},
         {"plate with hole grid", {&generate_plate_with_hole_grid<dim>, false}}});
      return registry;
    }

    /// Every rank holds the coarse mesh, at about 1 kB a cell.
    constexpr double max_coarse_cells = 2e7;

    void check_number(const std::size_t  given,
                      const std::size_t  wanted,
                      const std::string &parameter,
                      const std::string &meaning)
    {
      if (given != wanted)
        throw InputError("the generator takes " + std::to_string(wanted) +
                         (wanted == 1 ? " number" : " numbers") + " here, not " + std::to_string(given))
          .parameter(parameter)
          .allowed(meaning);
    }
  } // namespace

  std::vector<std::string> generator_names()
  {
    return generators<2>().names();
  }

  bool generator_has_corner(const std::string &name)
  {
    return !name.empty() && generators<2>().get(name).has_corner;
  }

  template <int dim>
  void generate_mesh(const MeshParameters &parameters, CoarseMesh<dim> &mesh)
  {
    generators<dim>().get(parameters.generator).generate(parameters, mesh);
    mesh.origin = parameters.generator;
  }

  std::vector<unsigned int> cell_counts(const MeshParameters            &parameters,
                                        const std::vector<unsigned int> &defaults,
                                        const std::string               &meaning)
  {
    if (parameters.cells.empty())
      return defaults;
    check_number(parameters.cells.size(), defaults.size(), "Mesh/Cells", meaning);
    double product = 1;
    for (const unsigned int count : parameters.cells)
      {
        if (count == 0)
          throw InputError("a body has at least one cell along each direction")
            .parameter("Mesh/Cells")
            .allowed(meaning);
        product *= count;
      }
    if (product > max_coarse_cells)
      throw InputError("too many cells for a mesh that every rank holds before refinement")
        .parameter("Mesh/Cells")
        .allowed("a product of at most 20,000,000")
        .hint("halve the counts and raise Mesh/Refinements, whose cells are distributed");
    return parameters.cells;
  }

  std::vector<double>
  lengths(const MeshParameters &parameters, const std::vector<double> &defaults, const std::string &meaning)
  {
    if (parameters.size.empty())
      return defaults;
    check_number(parameters.size.size(), defaults.size(), "Mesh/Size", meaning);
    if (!std::all_of(parameters.size.begin(), parameters.size.end(), [](const double l) { return l > 0; }))
      throw InputError("a body has positive lengths").parameter("Mesh/Size").allowed(meaning);
    return parameters.size;
  }

  template <int dim>
  void generate_box(const MeshParameters &parameters, CoarseMesh<dim> &mesh)
  {
    const std::string               directions = dim == 2 ? "along x, y" : "along x, y, z";
    const std::vector<unsigned int> counts =
      cell_counts(parameters, std::vector<unsigned int>(dim, 10), "counts " + directions);
    const std::vector<double> size =
      lengths(parameters, std::vector<double>(dim, 1.), "lengths " + directions + " [m], > 0");

    if (!parameters.corner.empty())
      check_number(parameters.corner.size(), dim, "Mesh/Corner", "coordinates " + directions + " [m]");
    dealii::Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = parameters.corner.empty() ? 0. : parameters.corner[d];
        upper[d] = lower[d] + size[d];
      }
    // colorized: boundary ids in the order x min, x max, y min, ...
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh.triangulation, counts, lower, upper, true);
    // It also numbers the cells by quadrant, which makes no materials.
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      cell->set_material_id(0);
    mesh.boundary_names = {{"left", 0}, {"right", 1}, {"bottom", 2}, {"top", 3}};
    if (dim == 3)
      mesh.boundary_names.insert({{"back", 4}, {"front", 5}});
  }

  PERIDEAL_INSTANTIATE(generate_mesh)
  PERIDEAL_INSTANTIATE(generate_box)
} // namespace perideal
