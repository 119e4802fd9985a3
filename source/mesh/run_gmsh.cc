// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/child_process.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/stop_request.h>
#include <perideal/mesh/mesh_file.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <unistd.h>
#include <vector>

namespace perideal
{
  namespace
  {
    /// A new directory, removed with its contents at the end of its life.
    class TemporaryDirectory
    {
    public:
      TemporaryDirectory()
      {
        name = (std::filesystem::temp_directory_path() / "perideal-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
          throw InputError("cannot make a temporary directory " + name + ": " + std::strerror(errno))
            .hint("set TMPDIR to a directory that can be written");
      }
      ~TemporaryDirectory()
      {
        std::error_code ignored;
        std::filesystem::remove_all(name, ignored);
      }
      TemporaryDirectory(const TemporaryDirectory &)            = delete;
      TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

      std::string file(const std::string &base) const { return name + "/" + base; }

    private:
      std::string name;
    };

    /// Runs gmsh, and ends it when the time is over or this process is asked to stop.
    ChildResult
    run(const std::vector<std::string> &arguments, const std::string &file, const double time_limit)
    {
      const StopRequest stop;
      int               n_minutes = 0;
      ChildResult       result    = run_child(arguments, [&](const double seconds) {
        if (stop.is_here())
          throw Stopped("while gmsh meshed " + file + "; gmsh was ended, nothing was computed");
        if (seconds > time_limit)
          {
            std::ostringstream limit;
            limit << time_limit;
            throw InputError(file + ": gmsh did not end within " + limit.str() + " s and was ended")
              .hint("open the file in gmsh and mesh it there; choose larger sizes, mesh it once and give the "
                             ".msh file, or raise Mesh/Gmsh time limit");
          }
        if (seconds > 60. * (n_minutes + 1))
          std::cout << "gmsh        still meshes " << file << " after " << ++n_minutes << " min" << std::endl;
      });
      if (!result.not_started.empty())
        throw InputError("cannot run the program " + arguments[0] + ": " + result.not_started)
          .hint("install it (apt-get install gmsh), or mesh the file elsewhere and give the .msh file");
      return result;
    }

    std::string text_of(const std::string &filename)
    {
      std::ifstream      stream(filename, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      return text.str();
    }

    /// Gmsh's first complaint; those behind it are mostly its consequences.
    std::string first_error(const std::string &log)
    {
      std::istringstream lines(log);
      std::string        line, last;
      while (std::getline(lines, line))
        {
          if (line.rfind("Error", 0) == 0)
            return line.substr(std::min(line.find(':') + 2, line.size()));
          if (!line.empty())
            last = line;
        }
      return last;
    }

    /// Lets gmsh read a file, do what the option says, and save it. Returns what it saved.
    std::string text_from_gmsh(const std::string &path,
                               const std::string &option,
                               const std::string &advice,
                               const double       time_limit)
    {
      // a name such as -x.geo would be an option
      const std::string        file = path.front() == '-' ? "./" + path : path;
      const TemporaryDirectory directory;
      const std::string        mesh = directory.file("mesh.msh");

      // Format 2.2, because in 4.1 deal.II misreads groups with reversed curves
      // (negative tags)
      const ChildResult gmsh =
        run({"gmsh", file, option, "-format", "msh22", "-o", mesh, "-v", "3"}, file, time_limit);
      const std::string text = text_of(mesh);
      if (gmsh.status != 0 || text.empty())
        throw InputError(file + ": gmsh failed (exit status " + std::to_string(gmsh.status) +
                         "): " + first_error(gmsh.out + gmsh.err))
          .hint(advice + "gmsh " + file + " " + option);
      return text;
    }
  } // namespace

  std::string run_gmsh(const std::string &geo_file, const int dim, const double time_limit)
  {
    return text_from_gmsh(geo_file, dim == 2 ? "-2" : "-3", "open the file in gmsh, or run: ", time_limit);
  }

  std::string convert_with_gmsh(const std::string &mesh_file, const double time_limit)
  {
    return text_from_gmsh(
      mesh_file, "-save", "open the file in gmsh to see what is wrong with it, or run: ", time_limit);
  }
} // namespace perideal
