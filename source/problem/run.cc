// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/problem/run.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace perideal
{
  Run::Run(const RunContext &context, MPI_Comm communicator)
    : context(context)
    , communicator(communicator)
    , screen(std::cout, dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , timings(communicator)
  {
  }

  void Run::warn(const std::string &text)
  {
    screen << "warning     " << text << std::endl;
    warnings.push_back(text);
  }
} // namespace perideal
