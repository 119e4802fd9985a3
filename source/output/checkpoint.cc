// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/checkpoint.h>
#include <perideal/output/checkpoint_file.h>
#include <perideal/output/checksum.h>
#include <perideal/output/files.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <memory>

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using hdf5::Unreadable;

    constexpr const char *bonds_alone = "broken bonds";

    InputError no_restart(const std::string &problem, const std::string &file)
    {
      return InputError(problem)
        .parameter("Checkpoints/Restart")
        .given(file)
        .hint("set Checkpoints/Restart = false to start from the beginning");
    }

    /// Lets every rank read by itself; returns the first complaint of a rank, to all. Collective.
    template <typename Read>
    std::string first_complaint(MPI_Comm communicator, const Read &read)
    {
      std::string complaint;
      try
        {
          read();
        }
      catch (const Unreadable &error)
        {
          complaint = error.what();
        }
      catch (const Json::exception &)
        {
          complaint = "the checkpoint was written by another version of the program";
        }
      for (const std::string &of_rank : dealii::Utilities::MPI::all_gather(communicator, complaint))
        if (!of_rank.empty())
          return of_rank;
      return "";
    }

    /// What checkpoint.json says.
    struct Pointer
    {
      std::string   file;
      std::uint32_t checksum = 0;
      /// Of the reading; empty: none.
      std::string problem;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &file &checksum &problem;
      }
    };

    /// Collective.
    Pointer read_pointer(const std::string &directory, MPI_Comm communicator)
    {
      Pointer result;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        {
          std::ifstream file(directory + "/checkpoint.json");
          const Json    pointer = Json::parse(file, nullptr, false);
          const auto    is      = [&](const char *name, const auto test) {
            return pointer.is_object() && pointer.contains(name) && test(pointer[name]);
          };
          if (!file.is_open())
            result.problem = "there is no checkpoint to continue from";
          else if (is("file", [](const Json &value) { return value.is_string(); }) &&
                   is("checksum", [](const Json &value) { return value.is_number_unsigned(); }))
            {
              result.file     = pointer["file"].get<std::string>();
              result.checksum = pointer["checksum"].get<std::uint32_t>();
            }
          else
            result.problem =
              "the checkpoint cannot be read: checkpoint.json is damaged, or of another version "
              "of the program";
        }
      return dealii::Utilities::MPI::broadcast(communicator, result, 0);
    }

  } // namespace

  InputError Checkpoint::lacks(const std::string &name)
  {
    return InputError("the checkpoint has no '" + name + "' that this scene could go on with")
      .parameter("Checkpoints/Restart")
      .hint("it was written by another version of the program: set Checkpoints/Restart = false to start from "
            "the beginning");
  }

  void
  write_checkpoint(const std::string &directory, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
  {
    const MPI_Comm    communicator = nodes.communicator;
    const bool        last_is_0    = read_pointer(directory, communicator).file == "checkpoint_0.h5";
    const std::string name         = last_is_0 ? "checkpoint_1.h5" : "checkpoint_0.h5";
    const std::string path         = directory + "/" + name;
    Checkpoint        whole        = checkpoint;
    for (const auto &[field, values] : checkpoint.fields)
      whole.node_arrays[field] = {
        "-",
        dealii::Utilities::MPI::max(nodes.n_owned > 0 ? unsigned(values.size() / nodes.n_owned) : 0u,
                                    communicator),
        values};
    whole.bond_arrays[bonds_alone] = {"-", 0, checkpoint.broken, {}};
    whole.sums["shares"]           = checkpoint.shares;
    const std::uint32_t sum        = checksum(write_checkpoint_file(path, whole, nodes));
    const std::string   complaint  = first_complaint(communicator, [&] {
      CheckpointFile(path, sum).verify(dealii::Utilities::MPI::this_mpi_process(communicator),
                                       dealii::Utilities::MPI::n_mpi_processes(communicator));
    });
    if (!complaint.empty())
      throw ComputationError("cannot write '" + path + "': is the disk full?");
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          replace_file(directory + "/checkpoint.json",
                       Json{{"file", name},
                            {"step", checkpoint.header.at("step")},
                            {"time", checkpoint.header.at("time")},
                            {"checksum", sum}}
                         .dump(1));
        }
      catch (const ComputationError &error)
        {
          problem = error.what();
        }
    problem = dealii::Utilities::MPI::broadcast(communicator, problem, 0);
    if (!problem.empty())
      throw ComputationError(problem);
  }

  Checkpoint read_checkpoint(const std::string &directory, const CheckpointNodes &nodes)
  {
    const MPI_Comm     communicator = nodes.communicator;
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const Pointer      pointer      = read_pointer(directory, communicator);
    if (!pointer.problem.empty())
      throw no_restart(pointer.problem, directory + "/checkpoint.json");
    const std::string path = directory + "/" + pointer.file;

    const auto read_together = [&](const auto &read) {
      const std::string complaint = first_complaint(communicator, read);
      if (!complaint.empty())
        throw no_restart(complaint, path);
    };
    std::unique_ptr<CheckpointFile> file;
    unsigned int                    same = 0;
    read_together([&] {
      file = std::make_unique<CheckpointFile>(path, pointer.checksum);
      file->verify(rank, dealii::Utilities::MPI::n_mpi_processes(communicator));
      same = file->is_as_written(nodes);
    });
    const bool         as_written = dealii::Utilities::MPI::min(same, communicator) != 0;
    const unsigned int of_rank    = as_written ? rank : CheckpointFile::all;
    Checkpoint         result;
    read_together([&] { result = file->read(nodes, of_rank); });
    for (const auto &[name, array] : result.node_arrays)
      result.fields[name] = array.values;
    result.broken = result.bond_arrays.at(bonds_alone).bonds;
    result.shares = result.sums.at("shares");
    return result;
  }
} // namespace perideal
