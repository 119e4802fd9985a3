// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/hdf5.h>
#include <perideal/base/links.h>

#include <deal.II/base/mpi.h>

#include <hdf5.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <numeric>

namespace perideal::hdf5
{
  namespace
  {
    /// From here on HDF5 prints nothing, and does not try again at the exit of the program what has failed
    /// before.
    void silence()
    {
      static const herr_t once = H5dont_atexit();
      static_cast<void>(once);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      errno = 0;
    }

    /// What the system said since errno was 0, in brackets; empty: nothing. HDF5 forgets it in its next call.
    std::string reason()
    {
      return errno == 0 ? "" : std::string(" (") + std::strerror(errno) + ")";
    }

    template <typename Number>
    hid_t type();
    template <>
    hid_t type<double>()
    {
      return H5T_NATIVE_DOUBLE;
    }
    template <>
    hid_t type<std::uint64_t>()
    {
      return H5T_NATIVE_UINT64;
    }
    template <>
    hid_t type<char>()
    {
      return H5T_NATIVE_CHAR;
    }

    std::uint64_t numbers_a_line(const std::vector<std::uint64_t> &shape)
    {
      return std::accumulate(shape.begin() + 1, shape.end(), std::uint64_t(1), std::multiplies<>());
    }

    /// Numbers that one message takes.
    constexpr std::size_t at_once = 1 << 24;

    template <typename Number>
    void send(const std::vector<Number> &values, MPI_Comm communicator)
    {
      for (std::size_t k = 0; k < values.size(); k += at_once)
        MPI_Send(values.data() + k,
                 static_cast<int>(std::min(at_once, values.size() - k) * sizeof(Number)),
                 MPI_BYTE,
                 0,
                 0,
                 communicator);
    }

    template <typename Number>
    void receive(std::vector<Number> &values, const unsigned int rank, MPI_Comm communicator)
    {
      for (std::size_t k = 0; k < values.size(); k += at_once)
        MPI_Recv(values.data() + k,
                 static_cast<int>(std::min(at_once, values.size() - k) * sizeof(Number)),
                 MPI_BYTE,
                 rank,
                 0,
                 communicator,
                 MPI_STATUS_IGNORE);
    }

    Handle make_space(const std::vector<std::uint64_t> &shape)
    {
      const std::vector<hsize_t> size(shape.begin(), shape.end());
      return {H5Screate_simple(size.size(), size.data(), nullptr), H5Sclose};
    }

    /// Calls transfer(space in memory, space in the file) for some lines of a table; without any, all is
    /// well.
    template <typename Transfer>
    bool transfer_lines(const std::vector<std::uint64_t> &shape,
                        const std::uint64_t               first,
                        const std::uint64_t               n_lines,
                        const Transfer                   &transfer)
    {
      std::vector<std::uint64_t> size = shape;
      size[0]                         = n_lines;
      if (n_lines * numbers_a_line(shape) == 0)
        return true;
      std::vector<hsize_t> start(size.size(), 0);
      start[0]                           = first;
      const Handle               memory  = make_space(size);
      const Handle               in_file = make_space(shape);
      const std::vector<hsize_t> count(size.begin(), size.end());
      return memory.is_open() && in_file.is_open() &&
             H5Sselect_hyperslab(
               in_file.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
             transfer(memory.get(), in_file.get()) >= 0;
    }

    /// In the latest format, the structures of which carry checksums.
    Handle create_file(const std::string &path)
    {
      silence();
      remove_link(path);
      errno = 0;
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
      return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
    }

    /// Closes a file that nobody will read. What HDF5 still has to write goes to memory: it keeps a file that
    /// it cannot flush, and falls over it when MPI ends.
    void give_up(Handle &file)
    {
      if (!file.is_open())
        return;
      // Memory has the limit of the sizes of files, too.
      if (rlimit size{}; getrlimit(RLIMIT_FSIZE, &size) == 0)
        {
          size.rlim_cur = size.rlim_max;
          setrlimit(RLIMIT_FSIZE, &size);
        }
      void     *descriptor = nullptr;
      const int memory     = memfd_create("given up", 0);
      if (memory >= 0 && H5Fget_vfd_handle(file.get(), H5P_DEFAULT, &descriptor) >= 0)
        dup2(memory, *static_cast<const int *>(descriptor));
      if (memory >= 0)
        ::close(memory);
      file.close();
    }

    Handle open_file(const std::string &path)
    {
      silence();
      return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
    }
  } // namespace

  bool Handle::close()
  {
    const std::int64_t was = id;
    id                     = -1;
    return was < 0 || closing(was) >= 0;
  }

  Writer::Writer(const std::string &path, MPI_Comm communicator)
    : path(path)
    , communicator(communicator)
    , is_first(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , file(is_first ? create_file(path) : Handle(-1, nullptr))
  {
    agree(file.is_open());
  }

  Writer::~Writer()
  {
    give_up(file);
  }

  void Writer::agree(const bool done) const
  {
    const std::string why = is_first && !done ? reason() : "";
    const auto of_first   = dealii::Utilities::MPI::broadcast(communicator, std::make_pair(done, why), 0);
    if (!of_first.first)
      throw ComputationError("cannot write '" + path + "'" +
                             (of_first.second.empty() ? ": is the disk full?" : of_first.second));
  }

  template <typename Number>
  void Writer::write(const std::string                &name,
                     const std::vector<Number>        &values,
                     const std::vector<std::uint64_t> &shape)
  {
    const auto                 lines = dealii::Utilities::MPI::all_gather(communicator, shape[0]);
    std::vector<std::uint64_t> total = shape;
    total[0]                         = std::accumulate(lines.begin(), lines.end(), std::uint64_t(0));
    if (!is_first)
      {
        send(values, communicator);
        agree(true);
        return;
      }
    errno = 0;
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.get(), 1);
    const Handle space = make_space(total);
    Handle       table(
      H5Dcreate2(
        file.get(), name.c_str(), type<Number>(), space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
    bool          written = table.is_open();
    std::uint64_t first   = 0;
    for (unsigned int rank = 0; rank < lines.size(); first += lines[rank++])
      {
        // Also what cannot be written is received.
        std::vector<Number> received(rank == 0 ? 0 : lines[rank] * numbers_a_line(shape));
        receive(received, rank, communicator);
        const Number *source = rank == 0 ? values.data() : received.data();
        written = written && transfer_lines(total, first, lines[rank], [&](hid_t memory, hid_t in_file) {
                    return H5Dwrite(table.get(), type<Number>(), memory, in_file, H5P_DEFAULT, source);
                  });
      }
    agree(written && table.close());
  }

  void Writer::close()
  {
    errno              = 0;
    const bool flushed = !is_first || H5Fflush(file.get(), H5F_SCOPE_LOCAL) >= 0;
    agree(flushed && file.close());
  }

  Reader::Reader(const std::string &path)
    : path(path)
    , file(open_file(path))
  {
    if (!file.is_open())
      throw Unreadable("'" + path + "' cannot be read" + reason());
  }

  Handle Reader::open(const std::string &table) const
  {
    Handle result(H5Dopen2(file.get(), table.c_str(), H5P_DEFAULT), H5Dclose);
    if (!result.is_open())
      throw Unreadable("table '" + table + "' of '" + path + "' cannot be read");
    return result;
  }

  std::vector<std::uint64_t> Reader::shape(const std::string &name) const
  {
    const Handle         table = open(name);
    const Handle         space(H5Dget_space(table.get()), H5Sclose);
    const int            rank = H5Sget_simple_extent_ndims(space.get());
    std::vector<hsize_t> result(std::max(rank, 0));
    if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.get(), result.data(), nullptr) < 0)
      throw Unreadable("table '" + name + "' of '" + path + "' cannot be read");
    return {result.begin(), result.end()};
  }

  template <typename Number>
  std::vector<Number>
  Reader::read(const std::string &name, const std::uint64_t first, const std::uint64_t n_lines) const
  {
    const auto   size  = shape(name);
    const Handle table = open(name);
    const Handle stored(H5Dget_type(table.get()), H5Tclose);
    bool         is_read =
      n_lines <= size[0] && first <= size[0] - n_lines && H5Tequal(stored.get(), type<Number>()) > 0;
    std::vector<Number> result(is_read ? n_lines * numbers_a_line(size) : 0);
    is_read = is_read && transfer_lines(size, first, n_lines, [&](const hid_t memory, const hid_t in_file) {
                return H5Dread(table.get(), type<Number>(), memory, in_file, H5P_DEFAULT, result.data());
              });
    if (!is_read)
      throw Unreadable("table '" + name + "' of '" + path + "' cannot be read");
    return result;
  }

#define INSTANTIATE(Number)                                                                                  \
  template void Writer::write(                                                                               \
    const std::string &, const std::vector<Number> &, const std::vector<std::uint64_t> &);                   \
  template std::vector<Number> Reader::read(const std::string &, const std::uint64_t, const std::uint64_t)   \
    const;
  INSTANTIATE(double)
  INSTANTIATE(std::uint64_t)
  INSTANTIATE(char)
#undef INSTANTIATE
} // namespace perideal::hdf5
