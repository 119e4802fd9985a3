// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/checkpoint_file.h>
#include <perideal/output/checksum.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <unordered_map>

namespace perideal
{
  using Json = nlohmann::ordered_json;
  using hdf5::Unreadable;

  namespace
  {
    /// What files of another layout have another number of.
    constexpr unsigned int format = 2;

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

    /// Where a table's lines of each rank begin, and where the last end.
    std::vector<std::uint64_t> begin_of_ranks(const Json &table)
    {
      std::vector<std::uint64_t> result(1, 0);
      for (const Json &lines : table.at("lines by rank"))
        result.push_back(result.back() + lines.get<std::uint64_t>());
      return result;
    }

  } // namespace

  std::string
  write_checkpoint_file(const std::string &path, const Checkpoint &checkpoint, const CheckpointNodes &nodes)
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
    const Json header = {
      {"format", format}, {"nodes", nodes.n_global}, {"tables", tables}, {"content", checkpoint.header}};
    const std::string       text = dealii::Utilities::MPI::broadcast(communicator, header.dump(), 0);
    const std::vector<char> letters(text.begin(), rank == 0 ? text.end() : text.begin());
    file.write("header", letters, {letters.size()});
    file.close();
    return text;
  }

  CheckpointFile::CheckpointFile(const std::string &path, const std::uint32_t header_checksum)
    : path(path)
    , file(path)
  {
    const std::vector<char> text = file.read<char>("header");
    if (checksum(text) != header_checksum)
      throw damaged("header");
    header = Json::parse(text);
    if (header.at("format") != format)
      throw Unreadable("the checkpoint was written by another version of the program");
  }

  template <typename Number, typename Visit>
  void CheckpointFile::visit_lines(const std::string &name, const unsigned int rank, const Visit &visit) const
  {
    const auto          begin = begin_of_ranks(tables().at(name));
    const std::uint64_t first = rank == all ? 0 : begin.at(rank), at_once = 1 << 20;
    const std::uint64_t last = rank == all ? begin.back() : begin.at(rank + 1);
    for (std::uint64_t at = first; at < last; at += at_once)
      {
        const std::uint64_t n      = std::min(at_once, last - at);
        const auto          values = file.read<Number>(name, at, n);
        for (std::uint64_t line = 0; line < n; ++line)
          visit(at + line, values.data() + line * (values.size() / n));
      }
  }

  Unreadable CheckpointFile::damaged(const std::string &table) const
  {
    return Unreadable("the checkpoint cannot be read: '" + table + "' of '" + path + "' is damaged");
  }

  template <typename Number>
  void
  CheckpointFile::verify(const std::string &name, const unsigned int rank, const unsigned int n_ranks) const
  {
    const auto begin = begin_of_ranks(tables().at(name));
    const auto shape = file.shape(name);
    if (shape != std::vector<std::uint64_t>{begin.back(), tables().at(name).at("width")})
      throw damaged(name);
    for (unsigned int k = rank; k + 1 < begin.size(); k += n_ranks)
      if (checksum(file.read<Number>(name, begin[k], begin[k + 1] - begin[k])) !=
          tables().at(name).at("checksums").at(k).get<std::uint32_t>())
        throw damaged(name);
  }

  void CheckpointFile::verify(const unsigned int rank, const unsigned int n_ranks) const
  {
    for (const auto &table : tables().items())
      if (table.value().at("holds keys").get<bool>())
        verify<std::uint64_t>(table.key(), rank, n_ranks);
      else
        verify<double>(table.key(), rank, n_ranks);
  }

  bool CheckpointFile::is_as_written(const CheckpointNodes &nodes) const
  {
    const auto         begin = begin_of_ranks(tables().at("nodes"));
    const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(nodes.communicator);
    if (begin.size() != dealii::Utilities::MPI::n_mpi_processes(nodes.communicator) + 1 ||
        begin[rank + 1] - begin[rank] != nodes.n_owned)
      return false;
    bool same = true;
    visit_lines<std::uint64_t>("nodes", rank, [&](const std::uint64_t line, const std::uint64_t *key) {
      same = same && *key == nodes.key[line - begin[rank]];
    });
    return same;
  }

  namespace
  {
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
      if (file.header.at("nodes") != nodes.n_global ||
          (rank == CheckpointFile::all && n_found != nodes.key.size()))
        throw Unreadable("the checkpoint belongs to another mesh");
      for (auto &[name, array] : checkpoint.node_arrays)
        {
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
      for (auto &[name, array] : checkpoint.bond_arrays)
        {
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
      checkpoint.header = file.header.at("content");
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

  Checkpoint CheckpointFile::read(const CheckpointNodes &nodes, const unsigned int rank) const
  {
    NodesByKey local;
    for (LocalIndex i = 0; i < nodes.key.size(); ++i)
      local[nodes.key[i]] = i;
    Checkpoint result;
    name_arrays(*this, result);
    read_nodes(*this, nodes, local, rank, result);
    read_bonds(*this, nodes, local, rank, result);
    read_sums(*this, dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0, rank, result);
    return result;
  }
} // namespace perideal
