// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/mesh/mesh.h>

#include <charconv>

namespace perideal
{
  namespace
  {
    template <typename Id>
    std::string name_of(const std::map<std::string, Id> &names, const Id id)
    {
      for (const auto &entry : names)
        if (entry.second == id)
          return entry.first;
      return std::to_string(id);
    }

    /// Looks a name or number up among the groups of one kind.
    template <typename Id>
    Id find_id(const std::string               &name_or_id,
               const std::string               &kind,
               const std::map<std::string, Id> &names,
               const std::set<Id>              &ids,
               const std::string               &parameter)
    {
      const auto named = names.find(name_or_id);
      if (named != names.end())
        return named->second;

      Id          number = 0;
      const char *end    = name_or_id.data() + name_or_id.size();
      const auto  result = std::from_chars(name_or_id.data(), end, number);
      if (result.ec == std::errc() && result.ptr == end && ids.count(number) > 0)
        return number;

      std::vector<std::string> choices;
      for (const Id id : ids)
        choices.push_back(name_of(names, id));
      throw InputError("the mesh has no " + kind + " of this name or number")
        .parameter(parameter)
        .given(name_or_id)
        .allowed(join_choices(choices))
        .nearest(nearest_name(name_or_id, choices));
    }
  } // namespace

  template <int dim>
  Mesh<dim>::Mesh(MPI_Comm communicator)
    // Cells stand in the order that their forest gives, whatever was halved and joined before: a run goes on
    // from a checkpoint to the last bit.
    : triangulation(
        communicator,
        dealii::Triangulation<dim>::none,
        dealii::parallel::distributed::Triangulation<dim>::mesh_reconstruction_after_repartitioning)
  {
  }

  template <int dim>
  dealii::types::boundary_id Mesh<dim>::boundary_id(const std::string &name_or_id,
                                                    const std::string &parameter) const
  {
    return find_id(name_or_id, "boundary", boundary_names, boundary_ids, parameter);
  }

  template <int dim>
  const std::vector<std::vector<dealii::Point<dim>>> &
  Mesh<dim>::inner_group(const std::string &name, const std::string &parameter) const
  {
    const auto found = inner_faces.find(name);
    if (found != inner_faces.end())
      return found->second;
    const std::string kind = dim == 2 ? "curve" : "surface";
    if (boundary_names.count(name) > 0)
      throw InputError("this physical " + kind + " bounds the body: there is nothing on its other side")
        .parameter(parameter)
        .given(name)
        .allowed("a physical " + kind + " inside the body");
    std::vector<std::string> choices;
    for (const auto &group : inner_faces)
      choices.push_back(group.first);
    throw InputError("the mesh has no physical " + kind + " of this name inside the body")
      .parameter(parameter)
      .given(name)
      .allowed(choices.empty() ? "the mesh has none; name one in its file, along sides of cells" :
                                 join_choices(choices))
      .nearest(nearest_name(name, choices));
  }

  template <int dim>
  dealii::types::material_id Mesh<dim>::material_id(const std::string &name_or_id,
                                                    const std::string &parameter) const
  {
    return find_id(name_or_id, "group of cells", material_names, material_ids, parameter);
  }

  template <int dim>
  std::string Mesh<dim>::boundary_name(const dealii::types::boundary_id id) const
  {
    return name_of(boundary_names, id);
  }

  template <int dim>
  std::string Mesh<dim>::material_name(const dealii::types::material_id id) const
  {
    return name_of(material_names, id);
  }

  PERIDEAL_INSTANTIATE_CLASS(Mesh)
} // namespace perideal
