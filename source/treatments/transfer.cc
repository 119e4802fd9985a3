// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/balanced_transfer.h>
#include <perideal/treatments/treatments.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    class TransferredTractions : public Tractions<dim>
    {
    public:
      TransferredTractions(const TreatedBody<dim> &body, const TreatedBonds<dim> &bonds)
        : Tractions<dim>(body, bonds)
        , transfer(TransferFunctions<dim>(body.nodes, gather_faces(body.faces, body.nodes.communicator)))
      {
      }

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        transfer.add_tractions(given, time, force);
      }

      std::string describe() const override { return ", tractions by transfer"; }

    private:
      const BalancedTransfer<dim> transfer;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_transfer(const TreatedBody<dim>  &body,
                                                   const TreatedBonds<dim> &bonds)
  {
    const Timings::Scope part(body.timings, "setup: transfer functions");
    return std::make_unique<TransferredTractions<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(load_by_transfer)
} // namespace perideal
