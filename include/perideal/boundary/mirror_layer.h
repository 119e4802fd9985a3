// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_mirror_layer_h
#define perideal_boundary_mirror_layer_h

#include <perideal/boundary/boundary_faces.h>

#include <array>
#include <optional>
#include <vector>

namespace perideal
{
  /**
   * Fictitious nodes behind plane boundaries with prescribed displacement: the
   * mirror images of the nodes within two horizons of the plane, so that the
   * families of real nodes are complete. With the prescribed value g at the
   * foot point on the plane, an image moves by
   *
   *     u_c(image) = 2 g_c - u_c(node)   where component c is prescribed,
   *     u_c(image) = u_c(node)           where it is free.
   *
   * Images of images fill the corners between planes.
   */
  template <int dim>
  class MirrorLayer
  {
  public:
    /// No fictitious nodes: nodes() are the real ones, which must outlive this object.
    explicit MirrorLayer(const NodeCloud<dim> &real);

    /// @throws InputError when a boundary with prescribed displacement is not
    ///   plane, or not along the axes while some components are free. Collective.
    MirrorLayer(const Mesh<dim>                      &mesh,
                const NodeCloud<dim>                 &real,
                const std::vector<BoundaryFace<dim>> &faces,
                const Loads<dim>                     &loads);

    /// Real nodes first, then the fictitious ones of this rank.
    const NodeCloud<dim> &nodes() const { return all ? *all : real_nodes; }
    LocalIndex            n_real() const { return n_real_nodes; }
    LocalIndex            n_fictitious() const { return nodes().size() - n_real_nodes; }

    /// False when the images break the symmetry of a symmetric operator: the
    /// prescribed components of a plane are neither the normal one alone nor
    /// all tangential ones.
    bool keeps_symmetry() const { return symmetric; }

    /// Displacement of all nodes from that of the real ones.
    /// @param with_values false: the linear part alone, all prescribed values zero.
    void extend(const NodalVector &real, const bool with_values, NodalVector &extended) const;

    /// Evaluates the prescribed values at @p time.
    void set_time(const Loads<dim> &loads, const double time);

    /// Prescribed displacement of the boundary that each component of an image
    /// reflects [m], over all nodes, 0 for real ones.
    void boundary_values(NodalVector &values) const;

    /// 1 + number of the condition that holds each component of an image, over
    /// all nodes; 0 where it is free and for real nodes.
    void holders(NodalVector &numbers) const;

  private:
    /// An image: u = sign u(source) + offset, the offset a sum of prescribed values.
    struct Image
    {
      LocalIndex             source;
      dealii::Tensor<1, dim> sign, offset;
      /// Condition that holds each component, or -1.
      std::array<int, dim> condition;
      /// Image of this earlier image, or of a real node if equal to source.
      LocalIndex         parent;
      unsigned int       plane;
      dealii::Point<dim> foot;
    };
    struct Plane
    {
      dealii::types::boundary_id boundary;
      dealii::Point<dim>         point, lower, upper;
      dealii::Tensor<1, dim>     normal;
      /// Condition that prescribes each component, or -1.
      std::array<int, dim> condition;
    };

    Plane make_plane(const Mesh<dim>                      &mesh,
                     const std::vector<BoundaryFace<dim>> &faces,
                     const dealii::types::boundary_id      boundary) const;
    void  add_images(const Plane &plane, const unsigned int plane_number);

    const NodeCloud<dim> &real_nodes;
    /// With the fictitious ones, if there may be any.
    std::optional<NodeCloud<dim>> all;
    LocalIndex                    n_real_nodes;
    std::vector<Image>            images;
    std::vector<Plane>            planes;
    bool                          symmetric = true;
  };
} // namespace perideal

#endif
