// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/mesh_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace perideal
{
  namespace
  {
    constexpr unsigned int no_corner = static_cast<unsigned int>(-1);

    template <typename Cell>
    unsigned int corner_at(const Cell &cell, const unsigned int vertex)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex_index(v) == vertex)
          return v;
      return no_corner;
    }

    /// Names for each number of a list the first one that it hangs together with.
    struct Merging
    {
      explicit Merging(const std::size_t n)
        : parent(n)
      {
        std::iota(parent.begin(), parent.end(), 0);
      }

      std::size_t root(std::size_t k) const
      {
        while (parent[k] != k)
          k = parent[k];
        return k;
      }

      void join(const std::size_t a, const std::size_t b)
      {
        const std::size_t of_a = root(a), of_b = root(b);
        parent[std::max(of_a, of_b)] = std::min(of_a, of_b);
      }

      std::vector<std::size_t> parent;
    };
  } // namespace

  template <int dim>
  MeshPoints<dim>::MeshPoints(const Mesh<dim> &mesh, const std::shared_ptr<const CellGraph<dim>> &graph)
    : mesh(mesh)
    , cells(graph)
    , place(graph->n_local())
  {
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        place[graph->node_of(cell)] = {cell->level(), cell->index()};
    number_points();
  }

  template <int dim>
  LocalIndex MeshPoints<dim>::behind(const Cell &cell, const unsigned int face) const
  {
    if (cell->at_boundary(face) || cell->neighbor(face)->has_children() ||
        cell->neighbor(face)->is_artificial())
      return none;
    return cells->node_of(cell->neighbor(face));
  }

  template <int dim>
  void MeshPoints<dim>::open(const IsOpen &is_open)
  {
    std::vector<double> bits(cells->n_owned(), 0.);
    bool                any = false;
    for (LocalIndex i = 0; i < bits.size(); ++i)
      for (const unsigned int f : dealii::GeometryInfo<dim>::face_indices())
        if (const LocalIndex j = behind(cell(i), f); j != none && is_open(i, j))
          {
            bits[i] += 1u << f;
            any = true;
          }
    any = dealii::Utilities::MPI::max(any ? 1u : 0u, cells->communicator) == 1;
    if (!any && open_faces.empty())
      return;
    const auto with_ghosts = cells->with_ghosts(bits);
    open_faces.clear();
    if (any)
      open_faces.assign(with_ghosts.begin(), with_ghosts.end());
    number_points();
  }

  template <int dim>
  void MeshPoints<dim>::find_groups(const unsigned int vertex, std::vector<Group> &groups) const
  {
    std::vector<LocalIndex> list;
    cells->add_cells_at(vertex, list);
    std::sort(list.begin(), list.end(), [&](const LocalIndex a, const LocalIndex b) {
      return cells->global_number(a) < cells->global_number(b);
    });
    std::vector<unsigned int> corner(list.size());
    bool                      is_whole = true;
    for (std::size_t k = 0; k < list.size(); ++k)
      {
        corner[k] = corner_at(cell(list[k]), vertex);
        is_whole  = is_whole && (open_faces.empty() || open_faces[list[k]] == 0);
      }
    Merging merging(list.size());
    if (is_whole)
      std::fill(merging.parent.begin(), merging.parent.end(), 0);
    else
      for (std::size_t k = 0; k < list.size(); ++k)
        if (corner[k] != no_corner)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int face  = dealii::GeometryInfo<dim>::vertex_to_face[corner[k]][d];
              const auto         here  = cell(list[k]);
              const LocalIndex   other = behind(here, face);
              const auto         found = std::find(list.begin(), list.end(), other);
              if (found == list.end() || (open_faces[list[k]] >> face & 1u) != 0)
                continue;
              // Where cells are of one size, the face is open on either side.
              if (!here->neighbor_is_coarser(face) &&
                  (open_faces[other] >> here->neighbor_of_neighbor(face) & 1u) != 0)
                continue;
              merging.join(k, found - list.begin());
            }
    std::vector<std::size_t> group_of_root(list.size());
    groups.clear();
    for (std::size_t k = 0; k < list.size(); ++k)
      {
        const std::size_t root = merging.root(k);
        if (root == k)
          {
            group_of_root[k] = groups.size();
            groups.emplace_back();
          }
        Group &group = groups[group_of_root[root]];
        if (corner[k] == no_corner)
          group.larger.push_back(list[k]);
        else
          group.corners.push_back({list[k], corner[k]});
      }
  }

  template <int dim>
  template <typename Visit>
  void MeshPoints<dim>::visit_groups(const Visit &visit) const
  {
    std::vector<bool>  is_done(mesh.triangulation.n_vertices(), false);
    std::vector<Group> groups;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          if (const unsigned int vertex = cell->vertex_index(v); !is_done[vertex])
            {
              is_done[vertex] = true;
              find_groups(vertex, groups);
              for (const Group &group : groups)
                if (!group.corners.empty())
                  visit(vertex, group, groups.size());
            }
  }

  template <int dim>
  void MeshPoints<dim>::number_points()
  {
    const LocalIndex n_owned = cells->n_owned();
    own.clear();
    around.clear();
    // Of each group the cell with the lowest number has the point, and its rank numbers it.
    using Found = std::array<double, n_corners>;
    std::vector<Found>   found(n_owned);
    std::set<LocalIndex> at_cracks;
    bool                 any_larger = false;
    visit_groups([&](const unsigned int, const Group &group, const std::size_t n_groups) {
      const Corner &first = group.corners.front();
      if (first.node < n_owned)
        {
          found[first.node][first.corner] = own.size();
          own.push_back(first);
        }
      any_larger = any_larger || !group.larger.empty();
      if (n_groups > 1)
        for (const Corner &corner : group.corners)
          at_cracks.insert(corner.node);
    });
    const GlobalIndex n_own  = own.size();
    GlobalIndex       before = 0;
    MPI_Exscan(&n_own, &before, 1, MPI_UINT64_T, MPI_SUM, cells->communicator);
    is_uneven = dealii::Utilities::MPI::max(any_larger ? 1u : 0u, cells->communicator) == 1;
    n_of_all  = dealii::Utilities::MPI::sum(n_own, cells->communicator);
    for (const Corner &corner : own)
      found[corner.node][corner.corner] += before;

    number.resize(n_owned);
    const auto of_all = cells->with_ghosts(found);
    visit_groups([&](const unsigned int, const Group &group, const std::size_t) {
      const Corner           &first   = group.corners.front();
      std::vector<LocalIndex> members = group.larger;
      for (const Corner &corner : group.corners)
        {
          members.push_back(corner.node);
          if (corner.node < n_owned)
            number[corner.node][corner.corner] = static_cast<GlobalIndex>(of_all[first.node][first.corner]);
        }
      for (const LocalIndex member : members)
        if (at_cracks.count(member) > 0)
          around[member].insert(around[member].end(), members.begin(), members.end());
    });
    for (auto &list : around)
      {
        std::sort(list.second.begin(), list.second.end());
        list.second.erase(std::unique(list.second.begin(), list.second.end()), list.second.end());
      }
  }

  template <int dim>
  std::vector<LocalIndex> MeshPoints<dim>::cells_around(const LocalIndex node) const
  {
    const auto at_crack = around.find(node);
    return at_crack != around.end() ? at_crack->second : cells->cells_around(cell(node));
  }

  template <int dim>
  dealii::Tensor<1, dim> MeshPoints<dim>::on_larger(const LocalIndex         node,
                                                    const unsigned int       vertex,
                                                    const CornerValues<dim> &values) const
  {
    using Info       = dealii::GeometryInfo<dim>;
    const auto where = cell(node);
    for (const unsigned int l : where->line_indices())
      if (where->line(l)->has_children() && where->line(l)->child(0)->vertex_index(1) == vertex)
        return 0.5 * (values[Info::line_to_cell_vertices(l, 0)] + values[Info::line_to_cell_vertices(l, 1)]);
    dealii::Tensor<1, dim> result;
    if constexpr (dim == 3)
      for (const unsigned int f : where->face_indices())
        if (where->face(f)->has_children() && where->face(f)->child(0)->vertex_index(3) == vertex)
          for (unsigned int v = 0; v < 4; ++v)
            result += 0.25 * values[Info::face_to_cell_vertices(f, v)];
    return result;
  }

  template <int dim>
  std::vector<CornerValues<dim>> MeshPoints<dim>::mean(std::vector<CornerValues<dim>> values) const
  {
    auto       result = cells->with_ghosts(std::move(values));
    const auto set    = [&](const Group &group, const dealii::Tensor<1, dim> &value) {
      for (const Corner &corner : group.corners)
        result[corner.node][corner.corner] = value;
    };
    // In place: each corner is of one group.
    visit_groups([&](const unsigned int, const Group &group, const std::size_t) {
      dealii::Tensor<1, dim> sum;
      for (const Corner &corner : group.corners)
        sum += result[corner.node][corner.corner];
      set(group, sum / static_cast<double>(group.corners.size()));
    });
    result.resize(cells->n_owned());
    // The edges on which vertices hang may end at vertices that hang on larger cells.
    for (unsigned int level = 1; is_uneven && level < mesh.triangulation.n_global_levels(); ++level)
      {
        const auto before = cells->with_ghosts(result);
        result            = before;
        visit_groups([&](const unsigned int vertex, const Group &group, const std::size_t) {
          if (!group.larger.empty())
            set(group, on_larger(group.larger.front(), vertex, before[group.larger.front()]));
        });
        result.resize(cells->n_owned());
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(MeshPoints)
} // namespace perideal
