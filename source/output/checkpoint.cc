// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/output/checkpoint.h>
#include <perideal/output/files.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <cstring>
#include <fstream>
#include <numeric>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using dealii::HDF5::File;

    /// This rank's lines of a table that all ranks fill together.
    struct Lines
    {
      hsize_t first, size, total, width;
    };

    /// HDF5 knows no empty tables: one line more than there are.
    template <typename T>
    void
    write_table(const File &file, const std::string &name, const std::vector<T> &values, const Lines &lines)
    {
      auto table = file.create_dataset<T>(name, {lines.total + 1, lines.width});
      if (lines.size == 0)
        table.template write_none<T>();
      else
        table.write_hyperslab(values, {lines.first, 0}, {lines.size, lines.width});
    }

    template <typename T>
    std::vector<T> read_table(const File &file, const std::string &name, const Lines &lines)
    {
      auto table = file.open_dataset(name);
      if (lines.size > 0)
        return table.template read_hyperslab<std::vector<T>>({lines.first, 0}, {lines.size, lines.width});
      table.template read_none<T>();
      return {};
    }

    /// Shows all lines of a table to this rank, visit(line, values of the line), some at a time.
    template <typename T, typename Visit>
    void visit_lines(const File &file, const std::string &name, const hsize_t width, const Visit &visit)
    {
      const hsize_t total = file.open_dataset(name).get_dimensions()[0] - 1, at_once = 1 << 20;
      for (hsize_t first = 0; first < total; first += at_once)
        {
          const hsize_t size   = std::min(at_once, total - first);
          const auto    values = read_table<T>(file, name, {first, size, total, width});
          for (hsize_t line = 0; line < size; ++line)
            visit(first + line, values.data() + line * width);
        }
    }

    /// As many lines of this rank as given, those of lower ranks before them.
    Lines lines_of_ranks(const std::vector<hsize_t> &sizes, const hsize_t width, MPI_Comm communicator)
    {
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
      const hsize_t      first = std::accumulate(sizes.begin(), sizes.begin() + rank, hsize_t(0));
      return {first, sizes[rank], std::accumulate(sizes.begin(), sizes.end(), hsize_t(0)), width};
    }

    Lines lines_of_ranks(const hsize_t size, const hsize_t width, MPI_Comm communicator)
    {
      return lines_of_ranks(dealii::Utilities::MPI::all_gather(communicator, size), width, communicator);
    }

    /// Values a node of a field. Collective.
    hsize_t width_of(const std::vector<double> &values, const CheckpointNodes &nodes)
    {
      return dealii::Utilities::MPI::max(nodes.n_owned > 0 ? values.size() / nodes.n_owned : std::size_t(0),
                                         nodes.communicator);
    }

    std::uint64_t join(const unsigned int *halves)
    {
      return (static_cast<std::uint64_t>(halves[0]) << 32) | halves[1];
    }

    /// Calls visit(name, values, lines) with the tables of a checkpoint.
    template <typename Visit>
    void visit_tables(const Checkpoint &checkpoint, const CheckpointNodes &nodes, const Visit &visit)
    {
      const MPI_Comm            communicator = nodes.communicator;
      std::vector<unsigned int> keys;
      for (LocalIndex i = 0; i < nodes.n_owned; ++i)
        keys.insert(keys.end(),
                    {static_cast<unsigned int>(nodes.key[i] >> 32), static_cast<unsigned int>(nodes.key[i])});
      visit("nodes", keys, lines_of_ranks(nodes.n_owned, 2, communicator));
      for (const auto &[name, values] : checkpoint.fields)
        visit("fields/" + name, values, lines_of_ranks(nodes.n_owned, width_of(values, nodes), communicator));
      visit("shares", checkpoint.shares, lines_of_ranks(1, checkpoint.shares.size(), communicator));
      std::vector<unsigned int> pairs;
      for (const BondEnds &bond : checkpoint.broken)
        for (const LocalIndex i : {bond.near, bond.far})
          pairs.insert(
            pairs.end(),
            {static_cast<unsigned int>(nodes.number[i] >> 32), static_cast<unsigned int>(nodes.number[i])});
      visit("broken", pairs, lines_of_ranks(checkpoint.broken.size(), 4, communicator));
    }

    void write_file(const std::string &path, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
    {
      File file(path, File::FileAccessMode::create, nodes.communicator);
      file.create_group("fields");
      visit_tables(checkpoint, nodes, [&](const auto &name, const auto &values, const Lines &lines) {
        write_table(file, name, values, lines);
      });
      Json header      = checkpoint.header;
      header["nodes"]  = nodes.n_global;
      header["shares"] = checkpoint.shares.size();
      header["broken by rank"] =
        dealii::Utilities::MPI::all_gather(nodes.communicator, hsize_t(checkpoint.broken.size()));
      for (const auto &[name, values] : checkpoint.fields)
        header["fields"][name] = width_of(values, nodes);
      const std::string               text = header.dump();
      const std::vector<unsigned int> letters(text.begin(), text.end());
      const bool is_first = dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0;
      write_table(file, "header", letters, {0, is_first ? letters.size() : 0, letters.size(), 1});
    }

    /// HDF5 through deal.II does not tell of a full disk.
    bool is_whole(const std::string &path, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
    {
      unsigned int whole = H5Fis_hdf5(path.c_str()) > 0;
      if (dealii::Utilities::MPI::min(whole, nodes.communicator) == 0)
        return false;
      const File file(path, File::FileAccessMode::open, nodes.communicator);
      visit_tables(checkpoint, nodes, [&](const auto &name, const auto &values, const Lines &lines) {
        using Values    = std::decay_t<decltype(values)>;
        const auto read = read_table<typename Values::value_type>(file, name, lines);
        whole           = whole && read.size() == values.size() &&
                std::memcmp(read.data(), values.data(), values.size() * sizeof(values[0])) == 0;
      });
      return dealii::Utilities::MPI::min(whole, nodes.communicator) != 0;
    }

    /// What checkpoint.json names; empty: nothing. Collective.
    std::string last_file(const std::string &directory, MPI_Comm communicator)
    {
      std::string name;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        {
          std::ifstream file(directory + "/checkpoint.json");
          const auto    pointer = Json::parse(file, nullptr, false);
          if (pointer.is_object() && pointer.contains("file"))
            name = pointer["file"].get<std::string>();
        }
      return dealii::Utilities::MPI::broadcast(communicator, name, 0);
    }

    InputError no_restart(const std::string &problem, const std::string &file)
    {
      return InputError(problem).parameter("Checkpoints/Restart").given(file);
    }

    Json read_header(const File &file)
    {
      std::string text;
      visit_lines<unsigned int>(
        file, "header", 1, [&](const hsize_t, const unsigned int *letter) { text += char(*letter); });
      return Json::parse(text, nullptr, false);
    }

    /// Local nodes by their number in the file.
    std::unordered_map<GlobalIndex, LocalIndex> find_nodes(const File &file, const CheckpointNodes &nodes)
    {
      std::unordered_map<std::uint64_t, LocalIndex> with_key;
      for (LocalIndex i = 0; i < nodes.key.size(); ++i)
        with_key[nodes.key[i]] = i;
      std::unordered_map<GlobalIndex, LocalIndex> result;
      visit_lines<unsigned int>(file, "nodes", 2, [&](const hsize_t line, const unsigned int *halves) {
        const auto found = with_key.find(join(halves));
        if (found != with_key.end())
          result[line] = found->second;
      });
      return result;
    }

    /// Fields, shares and broken bonds that another number of ranks wrote.
    void read_as_another(const File                                        &file,
                         const CheckpointNodes                             &nodes,
                         const std::unordered_map<GlobalIndex, LocalIndex> &local,
                         Checkpoint                                        &checkpoint)
    {
      for (const auto &field : checkpoint.header.at("fields").items())
        {
          const hsize_t        width  = field.value().get<hsize_t>();
          std::vector<double> &values = checkpoint.fields[field.key()];
          values.resize(width * nodes.n_owned);
          visit_lines<double>(
            file, "fields/" + field.key(), width, [&](const hsize_t line, const double *value) {
              const auto found = local.find(line);
              if (found != local.end() && found->second < nodes.n_owned)
                std::copy_n(value, width, values.begin() + width * found->second);
            });
        }
      const hsize_t width = checkpoint.header.at("shares").get<hsize_t>();
      checkpoint.shares.assign(width, 0.);
      const bool is_first = dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0;
      visit_lines<double>(file, "shares", width, [&](const hsize_t, const double *share) {
        for (hsize_t k = 0; k < width && is_first; ++k)
          checkpoint.shares[k] += share[k];
      });
      visit_lines<unsigned int>(file, "broken", 4, [&](const hsize_t, const unsigned int *halves) {
        const auto a = local.find(join(halves)), b = local.find(join(halves + 2));
        if (a != local.end() && b != local.end() && std::min(a->second, b->second) < nodes.n_owned)
          checkpoint.broken.push_back({std::min(a->second, b->second), std::max(a->second, b->second)});
      });
    }

    /// The same by as many ranks with the same nodes.
    void read_as_written(const File &file, const CheckpointNodes &nodes, Checkpoint &checkpoint)
    {
      const MPI_Comm communicator = nodes.communicator;
      for (const auto &field : checkpoint.header.at("fields").items())
        checkpoint.fields[field.key()] =
          read_table<double>(file,
                             "fields/" + field.key(),
                             lines_of_ranks(nodes.n_owned, field.value().get<hsize_t>(), communicator));
      checkpoint.shares = read_table<double>(
        file, "shares", lines_of_ranks(1, checkpoint.header.at("shares").get<hsize_t>(), communicator));
      const auto sizes  = checkpoint.header.at("broken by rank").get<std::vector<hsize_t>>();
      const auto halves = read_table<unsigned int>(file, "broken", lines_of_ranks(sizes, 4, communicator));
      std::unordered_map<GlobalIndex, LocalIndex> local;
      for (LocalIndex i = 0; i < nodes.number.size(); ++i)
        local[nodes.number[i]] = i;
      for (std::size_t k = 0; k < halves.size(); k += 4)
        checkpoint.broken.push_back(
          {local.at(join(halves.data() + k)), local.at(join(halves.data() + k + 2))});
    }
  } // namespace

  void
  write_checkpoint(const std::string &directory, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
  {
    const bool        last_is_0 = last_file(directory, nodes.communicator) == "checkpoint_0.h5";
    const std::string name      = last_is_0 ? "checkpoint_1.h5" : "checkpoint_0.h5";
    const std::string path      = directory + "/" + name;
    write_file(path, checkpoint, nodes);
    if (!is_whole(path, checkpoint, nodes))
      throw ComputationError("cannot write '" + path + "': is the disk full?");
    if (dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0)
      replace_file(
        directory + "/checkpoint.json",
        Json{{"file", name}, {"step", checkpoint.header.at("step")}, {"time", checkpoint.header.at("time")}}
          .dump(1));
  }

  Checkpoint read_checkpoint(const std::string &directory, const CheckpointNodes &nodes)
  {
    const MPI_Comm    communicator = nodes.communicator;
    const std::string name         = last_file(directory, communicator);
    if (name.empty())
      throw no_restart("there is no checkpoint to go on from", directory + "/checkpoint.json")
        .hint("set Checkpoints/Restart = false to start anew");
    const std::string  path  = directory + "/" + name;
    const unsigned int whole = H5Fis_hdf5(path.c_str()) > 0;
    if (dealii::Utilities::MPI::min(whole, communicator) == 0)
      throw no_restart("the checkpoint cannot be read", path);
    const File file(path, File::FileAccessMode::open, communicator);

    Checkpoint result;
    result.header = read_header(file);
    if (!result.header.is_object())
      throw no_restart("the checkpoint cannot be read", path);
    const auto   local = find_nodes(file, nodes);
    unsigned int is_there =
      result.header.value("nodes", GlobalIndex(0)) == nodes.n_global && local.size() == nodes.key.size();
    if (dealii::Utilities::MPI::min(is_there, communicator) == 0)
      throw no_restart("the checkpoint belongs to another mesh", path);

    unsigned int same =
      result.header.at("broken by rank").size() == dealii::Utilities::MPI::n_mpi_processes(communicator);
    for (LocalIndex i = 0; i < nodes.n_owned; ++i)
      {
        const auto found = local.find(nodes.number[i]);
        same             = same && found != local.end() && found->second == i;
      }
    if (dealii::Utilities::MPI::min(same, communicator) != 0)
      read_as_written(file, nodes, result);
    else
      read_as_another(file, nodes, local, result);
    return result;
  }
} // namespace perideal
