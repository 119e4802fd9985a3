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
  /// What may become of a cell: it is halved or joined; halved only, as bonds of it softened; or it stays.
  struct CellFate
  {
    static constexpr double changes = 0., is_halved = 1., stays = 2.;
  };

  /**
   * Takes what lasts from the nodes of one mesh to those of another, of which cells are halved or joined.
   *
   * Cells with a bond that broke, or softened until it bears less than half, stay as they are: all these
   * bonds are found again. Where bonds softened less, cells may be halved (CarriedSoftening). Smooth fields
   * are quadratic polynomials around each node, fitted to the bonds that hold the body together; at the
   * centroids of halves those of the nodes around are weighted by how near these are, linearly along each
   * edge of the cell: of waves of few cells, which no polynomial fits, straight lines from node to node are
   * left, where steps between cells would double their strain energy. All halves of a material get one amount
   * more, so that the sum over the body of values times volumes stays: momentum lasts. Halves that are halved
   * at once again follow the polynomial of the first, and keep its sum. Cells that are joined have the mean.
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
      /// What may become of it: a CellFate.
      fate,
      is_quiet,
      cost,
      /// Whether values of halves are known.
      has_halves,
      is_half,
      n_places
    };
    /// Of a polynomial without its constant; halves of a cell.
    static constexpr unsigned int n_coefficients = dim + dim * (dim + 1) / 2, n_halves = 1u << dim;

    /// The edges of a cell, the mean of parallel ones, in columns [m].
    static dealii::Tensor<2, dim> axes_of(const Cell &cell);
    /// From the middle of a cell to that of a half, the unit a whole edge; and in space [m].
    static dealii::Tensor<1, dim> unit_offset_of_half(const unsigned int half);
    static dealii::Tensor<1, dim> offset_of_half(const Cell &cell, const unsigned int half);
    /// Where the values of halves stand in the numbers of a cell.
    std::size_t first_half() const { return first_coefficient() + n_smooth * n_coefficients; }
    std::size_t first_coefficient() const { return n_places + n_constant + n_smooth; }

    /// By how much values times volumes of halves are more than those of their cells, the last their volume,
    /// by material; and the halves.
    struct Excess
    {
      std::map<dealii::types::material_id, std::vector<double>> of_material;
      std::vector<Cell>                                         halves;
    };

    /// What fit() looks at.
    struct Fitting;
    /// Fits the polynomials of smooth values around their values at nodes.
    void fit_polynomials(Fitting &fitting) const;
    /// Polynomials of owned nodes and their neighbours, each with its constant first, whose mean over halves
    /// of the cell is the value of the node. Collective.
    NodalVector centred_polynomials(const Fitting &fitting) const;
    /// Weighs the polynomials around each half.
    void find_halves(Fitting &fitting, const NodalVector &polynomials) const;

    Numbers of_child(const Numbers &parent, const dealii::Tensor<1, dim> &d) const;
    /// Halves of a cell by the numbers of the cell.
    void
    halve(const Cell &parent, const Numbers &numbers, std::vector<Numbers> &by_cell, Excess &excess) const;
    /// Takes from halves what values times volumes are more. Collective.
    void take_back(const Mesh<dim> &mesh, Excess &excess, std::vector<Numbers> &by_cell) const;
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
    /// By active cell; empty of cells of other ranks: Place, constants, values of smooth ones, coefficients,
    /// values of halves.
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
