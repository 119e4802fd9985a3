// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/vtu_text.h>

#include <deal.II/base/utilities.h>

#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include <array>
#include <sstream>

namespace perideal
{
  namespace
  {
    std::string base64(const void *const bytes, const std::size_t n)
    {
      const auto *const first = static_cast<const unsigned char *>(bytes);
      return dealii::Utilities::encode_base64(std::vector<unsigned char>(first, first + n));
    }

    /// The data of an array: numbers of blocks and bytes, then a block that zlib has compressed.
    template <typename T>
    std::string compressed(const std::vector<T> &values)
    {
      const std::size_t n_bytes = values.size() * sizeof(T);
      std::vector<char> block;
      if (n_bytes > 0)
        {
          boost::iostreams::filtering_ostream out;
          out.push(boost::iostreams::zlib_compressor(boost::iostreams::zlib::best_speed));
          out.push(boost::iostreams::back_inserter(block));
          out.write(reinterpret_cast<const char *>(values.data()), n_bytes);
        }
      const std::array<std::uint64_t, 4> head = {{n_bytes > 0 ? 1u : 0u, n_bytes, n_bytes, block.size()}};
      // An array without values has no block, and no size of one.
      return base64(head.data(), (n_bytes > 0 ? 4 : 3) * sizeof(head[0])) +
             base64(block.data(), block.size());
    }

    constexpr char float_type[] = "Float32";

    std::string head_of(const std::string &tag,
                        const std::string &type,
                        const std::string &name,
                        const unsigned int n_components)
    {
      return "<" + tag + " type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
             std::to_string(n_components) + "\"";
    }

    template <typename T>
    std::string array_text(const std::string    &type,
                           const std::string    &name,
                           const unsigned int    n_components,
                           const std::vector<T> &values)
    {
      return head_of("DataArray", type, name, n_components) + " format=\"binary\">\n" + compressed(values) +
             "\n</DataArray>\n";
    }

    /// Cells in VTK's order of points, which goes round faces.
    std::string cells_text(const VtuPiece &piece)
    {
      const unsigned int        n_corners = 1u << piece.dimension;
      const std::size_t         n_cells   = piece.corners.size() / n_corners;
      std::vector<std::int64_t> connectivity, offsets;
      connectivity.reserve(piece.corners.size());
      for (std::size_t cell = 0; cell < n_cells; ++cell)
        {
          for (unsigned int v = 0; v < n_corners; ++v)
            connectivity.push_back(piece.corners[n_corners * cell + (v ^ (v >> 1 & 1u))]);
          offsets.push_back(connectivity.size());
        }
      constexpr std::uint8_t quadrilateral = 9, hexahedron = 12;
      return "<Cells>\n" + array_text("Int64", "connectivity", 1, connectivity) +
             array_text("Int64", "offsets", 1, offsets) +
             array_text(
               "UInt8",
               "types",
               1,
               std::vector<std::uint8_t>(n_cells, piece.dimension == 2 ? quadrilateral : hexahedron)) +
             "</Cells>\n";
    }

    std::string data_text(const std::string &tag, const std::vector<VtuArray> &arrays)
    {
      std::string result = "<" + tag + ">\n";
      for (const VtuArray &array : arrays)
        result += array_text(float_type, array.name, array.n_components, array.values);
      return result + "</" + tag + ">\n";
    }

    std::string file_of(const std::string &type, const std::string &attributes, const std::string &content)
    {
      return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
             "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\""
             " compressor=\"vtkZLibDataCompressor\">\n<" +
             type + attributes + ">\n" + content + "</" + type + ">\n</VTKFile>\n";
    }
  } // namespace

  std::string vtu_text(const VtuPiece &piece)
  {
    std::ostringstream head;
    head.precision(12);
    head
      << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
      << piece.time
      << "</DataArray>\n<DataArray type=\"Int64\" Name=\"Step\" NumberOfTuples=\"1\" format=\"ascii\">"
      << piece.step << "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" << piece.points.size() / 3
      << "\" NumberOfCells=\"" << (piece.corners.size() >> piece.dimension) << "\">\n";
    return file_of("UnstructuredGrid",
                   "",
                   head.str() + "<Points>\n" + array_text(float_type, "Points", 3, piece.points) +
                     "</Points>\n" + cells_text(piece) + data_text("PointData", piece.point_data) +
                     data_text("CellData", piece.cell_data) + "</Piece>\n");
  }

  std::string pvtu_text(const VtuPiece &like, const std::vector<std::string> &files)
  {
    const auto list = [](const std::string &tag, const std::vector<VtuArray> &arrays) {
      std::string result = "<" + tag + ">\n";
      for (const VtuArray &array : arrays)
        result += head_of("PDataArray", float_type, array.name, array.n_components) + "/>\n";
      return result + "</" + tag + ">\n";
    };
    std::string content = "<PPoints>\n" + head_of("PDataArray", float_type, "Points", 3) +
                          "/>\n</PPoints>\n" + list("PPointData", like.point_data) +
                          list("PCellData", like.cell_data);
    for (const std::string &file : files)
      content += "<Piece Source=\"" + file + "\"/>\n";
    return file_of("PUnstructuredGrid", " GhostLevel=\"0\"", content);
  }
} // namespace perideal
