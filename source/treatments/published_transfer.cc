// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/published_transfer.h>
#include <perideal/operators/linear/nodal_springs.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "published transfer" of tractions: transfer functions as published, PDBC (2.17) and (4.1), with
 * chi and lambda of the scene (PublishedTransfer). What the sums of L make of the nodes' own displacements
 * are springs around the bonds, what they make of places is a given force.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class PublishedTransferTractions : public Tractions<dim>
    {
    public:
      PublishedTransferTractions(const TreatedBody<dim> &body, const TreatedBonds<dim> &bonds)
        : Tractions<dim>(body, bonds)
        , transfer(TransferFunctions<dim>(body.nodes, gather_faces(body.faces, body.nodes.communicator)),
                   body.loads,
                   body.parameters.transfer_chi,
                   body.parameters.transfer_lambda)
      {
      }

      std::shared_ptr<BondOperator<dim>> around(const std::shared_ptr<BondOperator<dim>> &bonds) override
      {
        if (transfer.springs().empty())
          return bonds;
        return std::make_shared<NodalSprings<dim>>(bonds, transfer.springs());
      }

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        transfer.add_tractions(given, time, force);
      }

      void add_given(const double time, NodalVector &force) const override
      {
        transfer.add_places(this->body.loads, time, force);
      }

      /// Its factor makes forces 39 % larger than tractions.
      bool keep_balance() const override { return false; }

      std::string describe() const override { return ", tractions by published transfer"; }

    private:
      const PublishedTransfer<dim> transfer;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_published_transfer(const TreatedBody<dim>  &body,
                                                             const TreatedBonds<dim> &bonds)
  {
    const Timings::Scope part(body.timings, "setup: transfer functions");
    return std::make_unique<PublishedTransferTractions<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(load_by_published_transfer)
} // namespace perideal
