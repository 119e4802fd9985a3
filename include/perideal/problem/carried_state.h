// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_carried_state_h
#define perideal_problem_carried_state_h

#include <perideal/output/checkpoint.h>
#include <perideal/problem/mesh_need.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Takes what lasts from the nodes of one mesh to those of another, of which cells are halved or joined.
   *
   * Cells with a bond that softened or broke stay as they are, so that all these bonds are found again, and
   * no others fail by the change. Smooth fields are quadratic polynomials around each node, fitted to the
   * bonds that hold the body together; halves get their values at their centroids, all by one amount the
   * nearer to where the sum over them times their volumes is that of the cell: momentum lasts. Cells that are
   * joined have the mean.
   */
  template <int dim>
  class CarriedState
  {
  public:
    /// Takes the state of the problem, whose force has bonds. Collective.
    /// @param keyed the nodes of the state
    /// @param need of that problem
    CarriedState(const Problem<dim>    &problem,
                 Checkpoint           &&state,
                 const CheckpointNodes &keyed,
                 const MeshNeed<dim>   &need);

    /// Fits polynomials to smooth fields around the nodes of cells that may be halved; the problem is not
    /// needed any more then. Collective.
    void fit(const Problem<dim> &problem, const MeshNeed<dim> &need);

    /// Whether it is one of a run that has begun.
    bool has_begun() const { return !state.header.empty(); }

    /// Halves and joins cells of a mesh on which nothing lives any more, until each is as small as it is
    /// needed and may be, and balances ranks by what their cells cost. Collective.
    /// @param levels how often a cell may be halved
    void change(Mesh<dim> &mesh, const MeshNeed<dim> &need, const unsigned int levels);

    /// Cost of the cells of the rank that has most, over the mean [-]: halves cost as much as what was
    /// halved. Collective.
    double imbalance(const Mesh<dim> &mesh) const;

    /// Whether change() would halve a cell that is to be small now. Collective.
    bool is_urgent(const Mesh<dim> &mesh, const MeshNeed<dim> &need, const unsigned int levels) const;

    /// Whether bonds failed of a cell that could have been halved. Collective.
    bool has_failed_larger_cells(const Mesh<dim> &mesh, const unsigned int levels) const;

    /// Time of the state [s], or of load steps.
    double time() const { return state.get<double>("time"); }

    /// The state by the nodes of the changed mesh. Collective.
    Checkpoint on(const Body<dim> &body, const CheckpointNodes &nodes) const;

  private:
    using Cell    = typename dealii::Triangulation<dim>::cell_iterator;
    using Numbers = std::vector<double>;

    /// Where in the numbers of a cell what stands.
    enum Place : std::size_t
    {
      is_kept,
      is_quiet,
      cost,
      n_places
    };
    /// Of a polynomial without its constant.
    static constexpr unsigned int n_coefficients = dim + dim * (dim + 1) / 2;

    Numbers of_child(const Numbers &parent, const dealii::Tensor<1, dim> &d) const;
    /// Halves of a cell by the numbers of the cell.
    void halve(const Cell &parent, const Numbers &numbers, std::vector<Numbers> &by_cell) const;
    /// Changes the mesh, with what its cells have. Collective.
    void carry(Mesh<dim> &mesh, const std::function<void()> &change);
    /// The cell that halves make.
    Numbers join(const Cell &parent) const;
    using Boxes = dealii::RTree<dealii::BoundingBox<dim>>;
    /// Boxes of the cells of all ranks that stay as they are, by how often they were halved. Collective.
    std::vector<Boxes> boxes_of_kept_cells(const Mesh<dim> &mesh) const;
    /// Flags cells; returns how many of all ranks are to be halved. Collective.
    GlobalIndex flag(Mesh<dim> &mesh, const MeshNeed<dim> &need, const bool joins) const;
    /// Own cells that may not be halved, as they or larger cells beside them are kept. Collective.
    std::vector<bool> blocked_cells(const dealii::Triangulation<dim> &mesh) const;

    Checkpoint state;
    /// Names of node arrays that are constant in cells, and of smooth ones.
    std::vector<std::string> constant, smooth;
    std::size_t              n_constant = 0, n_smooth = 0;
    /// By active cell; empty of cells of other ranks: Place, constants, values of smooth ones, coefficients.
    std::vector<Numbers> numbers_of_cell;

    /// Bonds of all ranks by the keys of their ends.
    struct KeyedBonds
    {
      std::vector<std::uint64_t> keys;
      std::vector<double>        values;
    };
    std::map<std::string, KeyedBonds> bonds;
  };
} // namespace perideal

#endif
