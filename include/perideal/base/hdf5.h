// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_hdf5_h
#define perideal_base_hdf5_h

#include <mpi.h>

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Thin layer over the C interface of HDF5 that checks every return code: dealii::HDF5 does so in Debug
   * only, prints what HDF5 says, and ends the program where an exception unwinds past an open file. Here
   * nothing is printed, and what unwinds closes its handles in silence. Tables may be empty.
   */
  namespace hdf5
  {
    /// A file or a table that cannot be read; the message names both.
    class Unreadable : public std::exception
    {
    public:
      explicit Unreadable(std::string problem)
        : message(std::move(problem))
      {
      }

      const char *what() const noexcept override { return message.c_str(); }

    private:
      std::string message;
    };

    /// An open object of HDF5 (hid_t); it closes as it goes.
    class Handle
    {
    public:
      using Close = int (*)(std::int64_t);

      Handle(const std::int64_t id, const Close closing)
        : id(id)
        , closing(closing)
      {
      }
      Handle(Handle &&other) noexcept
        : id(other.id)
        , closing(other.closing)
      {
        other.id = -1;
      }
      ~Handle() { close(); }
      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;
      Handle &operator=(Handle &&)      = delete;

      bool         is_open() const { return id >= 0; }
      std::int64_t get() const { return id; }
      /// False where HDF5 could not; once only.
      bool close();

    private:
      std::int64_t id;
      Close        closing;
    };

    /**
     * A new file that all ranks fill: the first writes what the others send it, since Open MPI prints lines
     * of its own where MPI-IO meets a full disk, and may not end then. All functions are collective, and
     * throw on all ranks alike.
     */
    class Writer
    {
    public:
      /// @throws ComputationError when the file cannot be made.
      Writer(const std::string &path, MPI_Comm communicator);

      /// Gives the file up where close() was not reached.
      ~Writer();
      Writer(const Writer &)            = delete;
      Writer &operator=(const Writer &) = delete;

      /**
       * Writes a table of double, std::uint64_t or char with the lines of the ranks one after another;
       * groups in its name are made.
       * @param values of this rank
       * @param shape of them: {lines} or {lines, numbers a line}
       * @throws ComputationError when it cannot be written.
       */
      template <typename Number>
      void write(const std::string                &name,
                 const std::vector<Number>        &values,
                 const std::vector<std::uint64_t> &shape);

      /// Closes the file, which is whole only then.
      /// @throws ComputationError when it cannot be written.
      void close();

    private:
      /// @throws ComputationError on all ranks when the first was not @p done.
      void agree(const bool done) const;

      std::string path;
      MPI_Comm    communicator;
      bool        is_first;
      /// Of the first rank.
      Handle file;
    };

    /// An existing file, read by one rank at will.
    class Reader
    {
    public:
      /// @throws Unreadable
      explicit Reader(const std::string &path);

      /// As Writer::write() was given it. @throws Unreadable
      std::vector<std::uint64_t> shape(const std::string &name) const;

      /// Lines of a table one after another. @throws Unreadable, also where the table has fewer lines or
      /// other numbers.
      template <typename Number>
      std::vector<Number>
      read(const std::string &name, const std::uint64_t first, const std::uint64_t n_lines) const;

      /// The whole table.
      template <typename Number>
      std::vector<Number> read(const std::string &name) const
      {
        return read<Number>(name, 0, shape(name)[0]);
      }

    private:
      Handle      open(const std::string &table) const;
      std::string path;
      Handle      file;
    };
  } // namespace hdf5
} // namespace perideal

#endif
