// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/checkpoint_file.h>
#include <perideal/output/checksum.h>

#include <deal.II/base/mpi.h>

#include <fstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  CheckpointPointer CheckpointPointer::read(const std::string &directory, MPI_Comm communicator)
  {
    CheckpointPointer result;
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
          result.problem = "the checkpoint cannot be read: checkpoint.json is damaged, or of another version "
                           "of the program";
      }
    return dealii::Utilities::MPI::broadcast(communicator, result, 0);
  }

  CheckpointFile::CheckpointFile(const std::string &path, const std::uint32_t header_checksum)
    : path(path)
    , file(path)
  {
    const std::vector<char> text = file.read<char>("header");
    if (checksum(text) != header_checksum)
      throw damaged("header");
    header_tree = Json::parse(text);
    if (header_tree.at("format") != format)
      throw hdf5::Unreadable("the checkpoint was written by another version of the program");
  }

  hdf5::Unreadable CheckpointFile::damaged(const std::string &table) const
  {
    return hdf5::Unreadable("the checkpoint cannot be read: '" + table + "' of '" + path + "' is damaged");
  }

  std::vector<std::uint64_t> CheckpointFile::begin_of_ranks(const std::string &table) const
  {
    std::vector<std::uint64_t> result(1, 0);
    for (const Json &lines : tables().at(table).at("lines by rank"))
      result.push_back(result.back() + lines.get<std::uint64_t>());
    return result;
  }

  void CheckpointFile::verify(const unsigned int rank, const unsigned int n_ranks) const
  {
    for (const auto &table : tables().items())
      if (table.value().at("holds keys").get<bool>())
        verify<std::uint64_t>(table.key(), rank, n_ranks);
      else
        verify<double>(table.key(), rank, n_ranks);
  }

  template <typename Number>
  void
  CheckpointFile::verify(const std::string &table, const unsigned int rank, const unsigned int n_ranks) const
  {
    const auto  begin       = begin_of_ranks(table);
    const Json &description = tables().at(table);
    const auto  width       = description.at("width").get<std::uint64_t>();
    if (file.shape(table) != std::vector<std::uint64_t>{begin.back(), width})
      throw damaged(table);
    for (unsigned int k = rank; k + 1 < begin.size(); k += n_ranks)
      if (checksum(file.read<Number>(table, begin[k], begin[k + 1] - begin[k])) !=
          description.at("checksums").at(k).get<std::uint32_t>())
        throw damaged(table);
  }
} // namespace perideal
