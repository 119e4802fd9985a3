// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/materials/lattice.h>
#include <perideal/output/summary.h>
#include <perideal/problem/advice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  std::string suitable_form(const SceneParameters &parameters, const GlobalIndex n_thin)
  {
    const bool consistent = parameters.model.is_consistent();
    if (n_thin > 0)
      return (parameters.model.has_forms() ? parameters.model.model->default_forms.otherwise : "energy") +
             " form: " + grouped(n_thin) +
             " cells lie in parts one cell thick, across which the consistent form has no gradient" +
             (consistent ? "; three cells would do" : "");
    const std::string why =
      "elastic statics, every cell has a gradient: exact for quadratic displacements, with "
      "a fraction of the error of Q1 finite elements";
    if (consistent)
      return "consistent form (chosen): " + why;
    return "consistent form: " + why + ", where the " +
           (parameters.model.has_forms() ? parameters.model.form + " form" :
                                           parameters.model.model->name + " model") +
           " is off by per cents at surfaces";
  }

  template <int dim>
  GlobalIndex thin_cells(const Problem<dim> &problem)
  {
    const auto &deficient = problem.discretisation.gradients.deficient();
    return dealii::Utilities::MPI::sum<GlobalIndex>(std::count(deficient.begin(), deficient.end(), true),
                                                    problem.run.communicator);
  }

  namespace
  {
    /// Smallest sine between the edges of a cell corner (in 3-D their scaled
    /// triple product) over the corners of all cells: 1 in boxes, 0 when collapsed.
    template <int dim>
    double smallest_corner(const Mesh<dim> &mesh)
    {
      double result = 1;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            {
              dealii::Tensor<2, dim> edges;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  edges[d] = cell->vertex(v ^ (1u << d)) - cell->vertex(v);
                  edges[d] /= edges[d].norm();
                }
              result = std::min(result, std::abs(determinant(edges)));
            }
      return dealii::Utilities::MPI::min(result, mesh.triangulation.get_communicator());
    }

    /// What models do in motion that solids do not.
    template <int dim>
    void warn_of_motion(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      const ModelParameters &model      = problem.parameters.model;
      const auto            &conditions = problem.loading.loads.conditions;
      if (model.is_tensor_involved() && !model.is_consistent() &&
          std::none_of(
            conditions.begin(), conditions.end(), [](const auto &c) { return c.prescribes_displacement(); }))
        result.push_back("bonds with tensors do not let a body turn freely that nothing holds: at surfaces "
                         "rotation costs energy, or sets it free where they push sideways or are cured");
    }

    /// Largest ratio of the sizes of two cells that share a face.
    template <int dim>
    double largest_jump(const Mesh<dim> &mesh)
    {
      double result = 1;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
              {
                const double ratio = cell->neighbor(f)->measure() / cell->measure();
                result             = std::max({result, ratio, 1. / ratio});
              }
      return dealii::Utilities::MPI::max(std::pow(result, 1. / dim), mesh.triangulation.get_communicator());
    }

    /// Bonds that count whole cells where no weights make up for it.
    template <int dim>
    void warn_of_whole_cells(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      const ModelParameters &model   = problem.parameters.model;
      const bool             springs = !model.model->corrects_surfaces;
      if (problem.parameters.quadrature.counts_parts() || model.form_traits().is_made_for_each_family)
        return;
      const std::string advice = "take Quadrature/Scheme = partial volume | exact, or Material/Form = " +
                                 (model.has_forms() ? model.model->default_forms.otherwise : "energy") +
                                 " | consistent";
      const double jump = largest_jump(*problem.body.mesh);
      if (jump > 1.5)
        result.push_back("cell sizes jump by a factor of " + short_number(jump) +
                         " between neighbours, of which families here count whole cells or none: expect "
                         "errors of tens of per cent; " +
                         advice);
      const double factor     = problem.parameters.nodes.horizon_factor;
      const double anisotropy = springs ? lattice_anisotropy<dim>(factor) : 0.;
      // Cubes at 3.01 have 0.13, squares at 2.01 have 0.75.
      if (!(std::abs(anisotropy) < 0.15))
        result.push_back("at a horizon factor of " + short_number(factor) + " bonds make regular cells " +
                         (std::isfinite(anisotropy) ?
                            short_number(100. * std::abs(anisotropy)) + " % too " +
                              (anisotropy > 0 ? "stiff" : "soft") + " along the mesh, for their shear" :
                            "of no shear stiffness") +
                         ": take another factor, such as 3.01, " + advice.substr(5));
    }

    /// Bonds between cells of two sizes, whose forces do not balance at uniform strain: a plate of which a
    /// quarter had cells a quarter as large bore 2.8 % less than with small ones all over in the energy form,
    /// 11 % more in the paper's, 0.1 % less in the consistent one.
    template <int dim>
    void warn_of_two_sizes(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      const ModelParameters &model = problem.parameters.model;
      if (model.is_consistent() || model.is_correspondence() || !model.has_forms())
        return;
      const bool adapts = problem.parameters.adaptation.is_by_need();
      if (adapts || largest_jump(*problem.body.mesh) > 1.9)
        result.push_back(
          std::string(adapts ? "the mesh adapts" : "cells of two sizes meet") +
          ": bonds between cells of two sizes make a body some per cent too soft or too stiff "
          "in this form, and may turn cracks; Material/Form = consistent loses next to nothing "
          "there");
    }

    template <int dim>
    void warn_of_cells(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      const double ratio = dealii::GridTools::maximal_cell_diameter(problem.body.mesh->triangulation) /
                           dealii::GridTools::minimal_cell_diameter(problem.body.mesh->triangulation);
      if (ratio > 100)
        result.push_back("cell sizes differ by a factor of " + short_number(ratio) +
                         ": expect more iterations");
      // Spheres of three spacings reach no neighbour along the long side from 9 on.
      const bool   spheres = problem.body.nodes->shape.empty();
      const double aspect  = problem.body.nodes->max_aspect_ratio;
      if (aspect > (spheres ? 4. : 10.))
        result.push_back(
          "aspect ratio of the cells up to " + short_number(aspect) + ": expect many iterations" +
          (spheres ? ", and families that reach few neighbours or none along the long side" : ""));
      const double corner = smallest_corner(*problem.body.mesh);
      if (corner < 0.3)
        result.push_back("distorted cells: the sharpest corner has a scaled Jacobian of " +
                         short_number(corner) + " (1 is a box, 0 a collapsed cell)");
    }

    /// Solids that are none, and bonds with tensors that are unstable.
    template <int dim>
    void warn_of_solids(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      for (const auto &[id, solid] : problem.body.solids)
        {
          const std::string name     = problem.body.mesh->material_name(id);
          const double      smallest = smallest_stiffness(solid);
          if (smallest <= 0)
            result.push_back("the stiffness of " + name +
                             " is not positive definite: its smallest eigenvalue is " +
                             short_number(smallest) + " Pa, so that some strains set energy free");
          if (!problem.parameters.model.is_tensor_involved() || !problem.discretisation.model ||
              smallest <= 0)
            continue;
          const double factor = problem.parameters.nodes.horizon_factor;
          const double waves  = smallest_wave_stiffness(*problem.discretisation.model, solid, factor);
          const double bonds  = smallest_bond_stiffness(*problem.discretisation.model, solid, factor);
          if (waves <= 0)
            result.push_back(
              "bonds of " + name + " are unstable at a horizon factor of " + short_number(factor) +
              ": short waves have negative stiffness, " + short_number(waves) +
              " times that of the solid. Enlarge Nodes/Horizon factor, or take Material/Form = "
              "consistent");
          else if (bonds < -1e-12)
            result.push_back(
              "bonds of " + name + " push sideways, " + short_number(-bonds) +
              " times what they pull along: stable inside the body, but perhaps not at its surfaces "
              "and cracks");
        }
    }

    /// Figures that other units than metres, kilograms and seconds leave behind.
    template <int dim>
    void warn_of_units(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      double longest = 0;
      for (int d = 0; d < dim; ++d)
        longest = std::max(longest, problem.body.box[1][d] - problem.body.box[0][d]);
      if (longest > 50. || longest < 1e-6)
        result.push_back(
          "the body is " + short_number(longest) +
          " m long. Is that meant? Lengths are in metres: a mesh drawn in millimetres takes Mesh/Scale "
          "= 0.001");
      const double unset = MaterialProperties().density;
      for (const auto id : problem.body.mesh->material_ids)
        {
          const MaterialProperties &material = problem.body.properties_of(id);
          if (material.symmetry.is_isotropic() && material.young_modulus < 1e6 && material.density > 1000. &&
              (problem.parameters.solver.is_dynamic() || material.density != unset))
            result.push_back("the material of " + problem.body.mesh->material_name(id) +
                             " has a Young's modulus of " + short_number(material.young_modulus) +
                             " Pa and a density of " + short_number(material.density) +
                             " kg/m^3. Is that meant? Moduli are in pascals: 70 GPa are 70e9");
        }
    }

    /// Two layers of cells do not determine the curvature across them: where it is not closed
    /// (PolynomialClosure), bending with a Poisson's ratio is held in plane strain there, by 1/(1-nu^2).
    template <int dim>
    void warn_of_two_layers(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      const auto &polynomials = problem.discretisation.gradients.polynomials;
      if (!polynomials)
        return;
      const GlobalIndex n_incomplete = dealii::Utilities::MPI::sum<GlobalIndex>(
        polynomials->n_incomplete() - polynomials->closure().cells().size(), problem.run.communicator);
      const GlobalIndex n_two = n_incomplete - problem.discretisation.counts.singular;
      double            ratio = 0;
      for (const auto &solid : problem.body.solids)
        ratio = std::max(ratio, std::abs(solid.second.isotropic().poisson_ratio));
      const double stiffer = 100. * (1. / (1. - ratio * ratio) - 1.);
      // Single cells in the corners of a mesh do no harm.
      if (100 * n_two > problem.body.nodes->n_global && stiffer > 1.)
        result.push_back(grouped(n_two) +
                         " cells lie in parts two cells thick, which do not tell the curvature "
                         "across them: bending there is about " +
                         short_number(std::round(stiffer)) + " % too stiff. Take three cells");
    }
  } // namespace

  template <int dim>
  std::vector<std::string> warnings(const Problem<dim> &problem)
  {
    std::vector<std::string> result     = problem.parameters.warnings;
    const bool               consistent = problem.parameters.model.is_consistent();
    const auto               statistics = problem.discretisation.families->statistics();
    const unsigned int       wanted     = dim == 2 ? 5 : 15;
    if (!consistent && statistics.min < wanted)
      result.push_back("the smallest family has " + std::to_string(statistics.min) +
                       " members, fewer than the " + std::to_string(wanted) +
                       (problem.parameters.model.model->has_law ? " that a gradient and what it misses take" :
                                                                  " moment conditions") +
                       ": enlarge Nodes/Horizon factor");
    warn_of_two_layers(problem, result);
    if (problem.discretisation.parts->n_bonds_across > 0)
      result.push_back(
        grouped(problem.discretisation.parts->n_bonds_across) +
        " bonds join parts of the mesh that share no face, across gaps narrower than the horizon: they "
        "move as one body. Refine until the gap is wider, or, where the solver knows Precracks, lay one "
        "into it");
    if (problem.discretisation.counts.singular > 0)
      result.push_back(
        grouped(problem.discretisation.counts.singular) +
        (consistent ? " cells lie in parts one cell thick, across which they have no gradient: take "
                      "three cells, or Material/Form = energy" :
                      " families miss a moment condition: uniform strain is not exact there (corners, thin "
                      "parts, flat cells, small horizon); see the field \"family status\""));
    if (problem.parameters.model.model->poisson_ratio)
      for (const auto &solid : problem.body.solids)
        {
          const ElasticConstants &given = solid.second.isotropic();
          const double            own   = problem.parameters.model.constants_of_model(given).poisson_ratio;
          if (std::abs(own - given.poisson_ratio) > 1e-3)
            result.push_back("bond-based materials have a Poisson's ratio of " + short_number(own) +
                             " here: " + problem.body.mesh->material_name(solid.first) +
                             " is not given its " + short_number(given.poisson_ratio));
        }
    warn_of_units(problem, result);
    warn_of_surfaces(problem, result);
    warn_of_motion(problem, result);
    if (problem.loading.tractions->complete_families())
      {
        const ElasticSolid<dim> &solid = problem.body.solids.begin()->second;
        const ElasticSolid<dim>  own =
          problem.parameters.model.is_tensor_involved() ?
             solid :
             ElasticSolid<dim>(problem.parameters.model.constants_of_model(solid.isotropic()));
        const double given = own.stiffness()[0][0][0][0];
        const double share = (*problem.discretisation.family_stiffness)[0][0][0][0] / given - 1.;
        if (std::abs(share) > 0.01)
          result.push_back("families are " + short_number(100. * std::abs(share)) + " % " +
                           (share > 0 ? "stiffer" : "softer") +
                           " along x than the material, and so is the body: take Material/Model = extended "
                           "ordinary, Form = energy, whose families are not");
      }
    warn_of_solids(problem, result);
    warn_of_whole_cells(problem, result);
    warn_of_two_sizes(problem, result);
    warn_of_cells(problem, result);
    warn_of_few_cells(problem, result);
    warn_of_crack_origins(problem, result);
    return result;
  }

  PERIDEAL_INSTANTIATE(thin_cells)
  PERIDEAL_INSTANTIATE(warnings)

} // namespace perideal
