// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_adaptation_h
#define perideal_mesh_adaptation_h

#include <perideal/mesh/mesh.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/vector.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace perideal
{
  /// Section "Adaptation": by the error of statics, or by need while load steps or a motion go on.
  struct AdaptationParameters
  {
    /// Estimated error of the displacement up to which cells are refined [-]; 0: the mesh stays as it is.
    double wanted_error = 0.;
    /// How often at most.
    unsigned int cycles = 10;
    /// Cells that marked cells may not make more of.
    unsigned int max_cells = 1000000;
    /// How often a cell of the mesh may be halved by need; 0: none is.
    unsigned int levels = 0;
    /// Utilisation of bonds from which cells are halved, 0 as MeshNeed has it, and below which they are
    /// joined again [-].
    double refine_from = 0., coarsen_below = 0.;
    /// How far around such a place cells are halved, in smallest spacings of the mesh [-].
    double reach = 12.;
    /// Steps of a motion between two looks.
    unsigned int interval = 5;
    /// Where cells are halved besides, not zero there: a formula in x, y, z, t; empty: nowhere.
    std::string where;
    /// Boundaries around which they are, and groups of cells that are: names or ids.
    std::vector<std::string> refine_at, refine_in;

    void declare(dealii::ParameterHandler &prm);

    /// Whether the mesh is to follow an estimate of the error.
    bool is_by_error() const { return wanted_error > 0.; }
    /// Whether it is to change while the scene runs.
    bool is_by_need() const { return levels > 0; }
    /// Whether cells are to be halved in places that the scene names.
    bool has_regions() const { return !where.empty() || !refine_at.empty() || !refine_in.empty(); }
  };

  /// Where the scene wants cells halved by name: around boundaries, and in groups of cells.
  struct NamedRegions
  {
    std::set<dealii::types::boundary_id> boundaries;
    std::set<dealii::types::material_id> groups;

    /// @throws InputError when the mesh has no boundary or group of a name.
    template <int dim>
    NamedRegions(const AdaptationParameters &parameters, const Mesh<dim> &mesh)
    {
      for (const std::string &name : parameters.refine_at)
        boundaries.insert(mesh.boundary_id(name, "Adaptation/Refine at"));
      for (const std::string &name : parameters.refine_in)
        groups.insert(mesh.material_id(name, "Adaptation/Refine in"));
    }
  };

  /// A mesh in figures.
  struct MeshFigures
  {
    dealii::types::global_cell_index n_cells = 0;
    /// From the coarse mesh on.
    std::vector<dealii::types::global_cell_index> n_cells_by_level;
    /// Shortest edge [m].
    double smallest_size = 0;
  };

  /// Counts and measures the cells. Collective.
  template <int dim>
  MeshFigures measure(const Mesh<dim> &mesh);

  /**
   * Marks the cells that carry most of an error: the largest ones, which add up to 0.7 of it (Doerfler's
   * marking). Collective.
   *
   * @param error_of_cells by active cell index, squares or energies, zero in cells of other ranks
   * @param max_cells that the mesh may have, those aside that p4est refines besides
   * @return whether any is marked; none where that took more cells
   */
  template <int dim>
  bool
  mark_largest(Mesh<dim> &mesh, const dealii::Vector<float> &error_of_cells, const unsigned int max_cells);

  /// Refines the marked cells, and those beside them that p4est keeps within one level; the mesh remembers it
  /// for copies. Nothing else may live on the mesh meanwhile. Collective.
  template <int dim>
  void refine_marked(Mesh<dim> &mesh);

  /// How often a cell was halved since the mesh adapts.
  template <int dim>
  unsigned int halvings(const Mesh<dim>                                          &mesh,
                        const typename dealii::Triangulation<dim>::cell_iterator &cell);

  /// Gives ranks contiguous parts of the order of p4est with weights as equal as can be. Nothing else may
  /// live on the mesh meanwhile. Collective.
  /// @param weight of an owned cell, less than 2^31
  template <int dim>
  void balance_ranks(
    Mesh<dim>                                                                                     &mesh,
    const std::function<unsigned int(const typename dealii::Triangulation<dim>::cell_iterator &)> &weight);

  /// Adapts a mesh that has not been adapted to the refined cells of one that was. Collective.
  /// @param cells_of_ranks how many cells each rank had; of another number of ranks it counts for nothing
  template <int dim>
  void adapt_like(const std::set<dealii::CellId>   &adapted,
                  const std::vector<std::uint64_t> &cells_of_ranks,
                  Mesh<dim>                        &mesh);

  /// Refines cells until all have children that are among those of another mesh that have. Collective on
  /// distributed triangulations.
  template <int dim>
  void refine_like(const std::set<dealii::CellId> &refined, dealii::Triangulation<dim> &triangulation);
} // namespace perideal

#endif
