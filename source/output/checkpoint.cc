// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/hdf5.h>
#include <perideal/output/checkpoint.h>
#include <perideal/output/checkpoint_file.h>
#include <perideal/output/checksum.h>
#include <perideal/output/files.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <numeric>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using hdf5::Unreadable;

    std::string node_table(const std::string &name)
    {
      return "node arrays/" + name;
    }

    std::string bond_table(const std::string &name, const std::string &part)
    {
      return "bond arrays/" + name + "/" + part;
    }

    std::string sum_table(const std::string &name)
    {
      return "sums/" + name;
    }

    /// Calls visit(name, unit, numbers a line, lines of this rank, values) with the tables of a checkpoint.
    template <typename Visit>
    void visit_tables(const Checkpoint &checkpoint, const CheckpointNodes &nodes, const Visit &visit)
    {
      visit("nodes",
            "-",
            1,
            nodes.n_owned,
            std::vector<std::uint64_t>(nodes.key.begin(), nodes.key.begin() + nodes.n_owned));
      for (const auto &[name, array] : checkpoint.node_arrays)
        {
          // Where only the first nodes have values, zeros follow.
          std::vector<double> values = array.values;
          values.resize(std::size_t(array.width) * nodes.n_owned);
          visit(node_table(name), array.unit, array.width, nodes.n_owned, values);
        }
      for (const auto &[name, array] : checkpoint.bond_arrays)
        {
          std::vector<std::uint64_t> ends;
          for (const BondEnds &bond : array.bonds)
            ends.insert(ends.end(), {nodes.key[bond.near], nodes.key[bond.far]});
          visit(bond_table(name, "ends"), "-", 2, array.bonds.size(), ends);
          visit(bond_table(name, "values"), array.unit, array.width, array.bonds.size(), array.values);
        }
      for (const auto &[name, values] : checkpoint.sums)
        visit(sum_table(name), "-", values.size(), 1, values);
    }

    /// Writes all tables; returns what the header says of them, and the header itself. Collective.
    std::string
    write_file(const std::string &path, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
    {
      const MPI_Comm     communicator = nodes.communicator;
      const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
      hdf5::Writer       file(path, communicator);
      Json               tables = Json::object();
      visit_tables(checkpoint,
                   nodes,
                   [&](const std::string  &name,
                       const auto         &unit,
                       const std::uint64_t width,
                       const std::uint64_t n,
                       const auto         &values) {
                     file.write(name, values, {n, width});
                     tables[name] = {
                       {"unit", unit},
                       {"width", width},
                       {"holds keys", std::is_integral_v<std::decay_t<decltype(values[0])>>},
                       {"lines by rank", dealii::Utilities::MPI::all_gather(communicator, n)},
                       {"checksums", dealii::Utilities::MPI::all_gather(communicator, checksum(values))}};
                   });
      const Json              header = {{"format", CheckpointFile::format},
                                        {"nodes", nodes.n_global},
                                        {"tables", tables},
                                        {"content", checkpoint.header}};
      const std::string       text   = dealii::Utilities::MPI::broadcast(communicator, header.dump(), 0);
      const std::vector<char> letters(text.begin(), rank == 0 ? text.end() : text.begin());
      file.write("header", letters, {letters.size()});
      file.close();
      return text;
    }

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

    /// Whether as many ranks with the same nodes wrote the file: the answer for this rank.
    bool is_as_written(const CheckpointFile &file, const CheckpointNodes &nodes)
    {
      const auto         begin = file.begin_of_ranks("nodes");
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(nodes.communicator);
      if (begin.size() != dealii::Utilities::MPI::n_mpi_processes(nodes.communicator) + 1 ||
          begin[rank + 1] - begin[rank] != nodes.n_owned)
        return false;
      bool same = true;
      file.visit_lines<std::uint64_t>("nodes", rank, [&](const std::uint64_t line, const std::uint64_t *key) {
        same = same && *key == nodes.key[line - begin[rank]];
      });
      return same;
    }

    using NodesByKey = std::unordered_map<std::uint64_t, LocalIndex>;

    void read_nodes(const CheckpointFile  &file,
                    const CheckpointNodes &nodes,
                    const NodesByKey      &local,
                    const unsigned int     rank,
                    Checkpoint            &checkpoint)
    {
      std::unordered_map<std::uint64_t, LocalIndex> node_of_line;
      GlobalIndex                                   n_found = 0;
      file.visit_lines<std::uint64_t>("nodes", rank, [&](const std::uint64_t line, const std::uint64_t *key) {
        const auto found = local.find(*key);
        n_found += found != local.end();
        if (found != local.end() && found->second < nodes.n_owned)
          node_of_line[line] = found->second;
      });
      if (file.header().at("nodes") != nodes.n_global ||
          (rank == CheckpointFile::all && n_found != nodes.key.size()))
        throw Unreadable("the checkpoint belongs to another mesh");
      for (auto &[name, named] : checkpoint.node_arrays)
        {
          auto &array = named; // a lambda of C++17 takes no structured binding
          array.values.resize(std::size_t(array.width) * nodes.n_owned);
          file.visit_lines<double>(
            node_table(name), rank, [&](const std::uint64_t line, const double *value) {
              const auto found = node_of_line.find(line);
              if (found != node_of_line.end())
                std::copy_n(
                  value, array.width, array.values.begin() + std::size_t(array.width) * found->second);
            });
        }
    }

    void read_bonds(const CheckpointFile  &file,
                    const CheckpointNodes &nodes,
                    const NodesByKey      &local,
                    const unsigned int     rank,
                    Checkpoint            &checkpoint)
    {
      for (auto &[name, named] : checkpoint.bond_arrays)
        {
          auto             &array = named; // a lambda of C++17 takes no structured binding
          std::vector<bool> is_here;
          file.visit_lines<std::uint64_t>(
            bond_table(name, "ends"), rank, [&](const std::uint64_t, const std::uint64_t *key) {
              const auto a = local.find(key[0]), b = local.find(key[1]);
              is_here.push_back(a != local.end() && b != local.end() &&
                                std::min(a->second, b->second) < nodes.n_owned);
              if (is_here.back())
                array.bonds.push_back({std::min(a->second, b->second), std::max(a->second, b->second)});
            });
          if (array.width == 0)
            continue;
          auto here = is_here.begin();
          file.visit_lines<double>(
            bond_table(name, "values"), rank, [&](const std::uint64_t, const double *value) {
              if (*here++)
                array.values.insert(array.values.end(), value, value + array.width);
            });
        }
    }

    /// @param rank CheckpointFile::all: the first rank takes the sums.
    void read_sums(const CheckpointFile &file,
                   const bool            is_first,
                   const unsigned int    rank,
                   Checkpoint           &checkpoint)
    {
      for (auto &[name, values] : checkpoint.sums)
        {
          bool       is_new = true;
          const auto width  = file.tables().at(sum_table(name)).at("width").get<std::size_t>();
          auto      &sum    = values;
          sum.assign(width, 0.);
          if (rank != CheckpointFile::all || is_first)
            file.visit_lines<double>(sum_table(name), rank, [&](const std::uint64_t, const double *share) {
              for (std::size_t k = 0; k < width; ++k)
                sum[k] = is_new ? share[k] : sum[k] + share[k];
              is_new = false;
            });
        }
    }

    /// Makes the arrays that a file holds, without values.
    void name_arrays(const CheckpointFile &file, Checkpoint &checkpoint)
    {
      checkpoint.header = file.header().at("content");
      for (const auto &table : file.tables().items())
        {
          const std::string &key   = table.key();
          const auto         slash = key.find('/'), last = key.rfind('/');
          const std::string  kind = key.substr(0, slash), name = key.substr(slash + 1);
          const auto         unit  = table.value().at("unit").get<std::string>();
          const auto         width = table.value().at("width").get<unsigned int>();
          if (kind == "node arrays")
            checkpoint.node_arrays[name] = {unit, width, {}};
          else if (kind == "sums")
            checkpoint.sums[name];
          else if (kind == "bond arrays" && key.substr(last) == "/values")
            checkpoint.bond_arrays[key.substr(slash + 1, last - slash - 1)] = {unit, width, {}, {}};
        }
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
    const bool        last_is_0 = CheckpointPointer::read(directory, communicator).file == "checkpoint_0.h5";
    const std::string name      = last_is_0 ? "checkpoint_1.h5" : "checkpoint_0.h5";
    const std::string path      = directory + "/" + name;
    const std::uint32_t sum     = checksum(write_file(path, checkpoint, nodes));
    const std::string   complaint = first_complaint(communicator, [&] {
      CheckpointFile(path, sum).verify(dealii::Utilities::MPI::this_mpi_process(communicator),
                                       dealii::Utilities::MPI::n_mpi_processes(communicator));
    });
    if (!complaint.empty())
      throw ComputationError("cannot write '" + path + "': is the disk full?");
    write_together(communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        replace_file(directory + "/checkpoint.json",
                     Json{{"file", name},
                          {"step", checkpoint.header.at("step")},
                          {"time", checkpoint.header.at("time")},
                          {"checksum", sum}}
                       .dump(1));
    });
  }

  Checkpoint read_checkpoint(const std::string &directory, const CheckpointNodes &nodes)
  {
    const MPI_Comm          communicator = nodes.communicator;
    const unsigned int      rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const CheckpointPointer pointer      = CheckpointPointer::read(directory, communicator);
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
      same = is_as_written(*file, nodes);
    });
    const bool         as_written = dealii::Utilities::MPI::min(same, communicator) != 0;
    const unsigned int of_rank    = as_written ? rank : CheckpointFile::all;
    Checkpoint         result;
    read_together([&] {
      NodesByKey local;
      for (LocalIndex i = 0; i < nodes.key.size(); ++i)
        local[nodes.key[i]] = i;
      name_arrays(*file, result);
      read_nodes(*file, nodes, local, of_rank, result);
      read_bonds(*file, nodes, local, of_rank, result);
      read_sums(*file, rank == 0, of_rank, result);
    });
    return result;
  }
} // namespace perideal
