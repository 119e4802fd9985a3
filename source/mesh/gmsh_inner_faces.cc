// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/mesh/gmsh_elements.h>
#include <perideal/mesh/gmsh_inner_faces.h>
#include <perideal/mesh/gmsh_lines.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    /// Node numbers around an element's face, sorted; unused ones are 0.
    using Key = std::array<std::uint64_t, 4>;

    template <typename Nodes, typename Corners>
    Key key_of(const Nodes &nodes, const Corners &corners)
    {
      Key key = {};
      std::transform(
        corners.begin(), corners.end(), key.begin(), [&](const int corner) { return nodes[corner]; });
      std::sort(key.begin(), key.end());
      return key;
    }

    /// Corners of the sides of a quadrilateral and of a hexahedron in Gmsh's numbering.
    constexpr std::array<std::array<int, 2>, 4> sides_of_quad = {{{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}}};
    constexpr std::array<std::array<int, 4>, 6> sides_of_hex  = {
       {{{0, 1, 2, 3}}, {{4, 5, 6, 7}}, {{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}, {{3, 0, 4, 7}}}};

    /// A part of the text and what comes in its place.
    struct Edit
    {
      std::size_t begin, end;
      std::string text;
    };

    class Separation
    {
    public:
      Separation(const std::string                &text,
                 const std::string                &filename,
                 const int                         dim,
                 const std::map<std::string, int> &names)
        : text(text)
        , filename(filename)
        , names(names)
        , lines(text, filename)
        , dim(dim)
      {
      }

      GmshInnerFaces run();

    private:
      struct Face
      {
        std::array<std::uint64_t, 4> nodes;
        int                          n_nodes, tag;
        /// Its line of the file, and the block that it is in.
        std::size_t begin, end, block;
        /// Number of cells that it is a side of.
        unsigned int n_cells = 0;

        bool is_inner() const { return n_cells > 1; }
      };
      using Words = std::vector<std::uint64_t>;
      /// The heading of elements, and which of its words is their number.
      struct Block
      {
        std::size_t begin, end;
        Words       heading;
        std::size_t count;
      };

      Words       read_words(const std::string &section);
      std::size_t begin_of_line() const { return lines.line().data() - text.data(); }
      std::size_t end_of_line() const { return begin_of_line() + lines.line().size(); }

      void read_entities();
      void read_nodes();
      void read_elements_2();
      void read_elements_4();
      void begin_block(const Words &heading, const std::size_t count);
      void read_element(GmshFields &fields, const int type, const int tag);
      void count_cells();
      void check_groups() const;

      std::map<int, std::vector<std::vector<dealii::Point<3>>>> inner_groups() const;
      std::string                                               text_without_inner_faces() const;

      const std::string                &text;
      const std::string                &filename;
      const std::map<std::string, int> &names;
      GmshLines                         lines;
      const int                         dim;

      bool                                                is_version_4 = false;
      std::map<int, int>                                  tag_of_entity;
      std::unordered_map<std::uint64_t, dealii::Point<3>> position;
      std::vector<std::array<std::uint64_t, 8>>           cells;
      std::vector<Face>                                   faces;
      /// The heading of the section of elements, then, in format 4.1, those of its blocks.
      std::vector<Block> blocks;
    };

    Separation::Words Separation::read_words(const std::string &section)
    {
      GmshFields    fields(lines.entry(section));
      Words         words;
      std::uint64_t word = 0;
      while (!fields.at_end() && fields.read(word))
        words.push_back(word);
      return words;
    }

    void Separation::read_entities()
    {
      std::array<std::uint64_t, 4> counts = {};
      lines.read("Entities", counts[0], counts[1], counts[2], counts[3]);
      for (int d = 0; d < 4; ++d)
        for (std::uint64_t i = 0; i < counts[d]; ++i)
          {
            GmshFields fields(lines.entry("Entities"));
            double     coordinate = 0;
            int        entity = 0, n_tags = 0, tag = 0;
            fields.read(entity);
            for (int c = 0; c < (d == 0 ? 3 : 6); ++c)
              fields.read(coordinate);
            if (fields.read(n_tags) && n_tags > 0 && fields.read(tag) && d == dim - 1)
              tag_of_entity[entity] = tag;
          }
      lines.expect_end("Entities");
    }

    void Separation::read_nodes()
    {
      const std::uint64_t n_blocks = is_version_4 ? read_words("Nodes").at(0) : 1;
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          const std::uint64_t count = is_version_4 ? read_words("Nodes").at(3) : read_words("Nodes").at(0);
          std::vector<std::uint64_t> numbers(count);
          if (is_version_4)
            for (std::uint64_t &number : numbers)
              lines.read("Nodes", number);
          for (std::uint64_t &number : numbers)
            {
              dealii::Point<3> x;
              if (is_version_4)
                lines.read("Nodes", x[0], x[1], x[2]);
              else
                lines.read("Nodes", number, x[0], x[1], x[2]);
              position[number] = x;
            }
        }
      lines.expect_end("Nodes");
    }

    void Separation::read_element(GmshFields &fields, const int type, const int tag)
    {
      const GmshElementType       *element = gmsh_element_type(type);
      std::array<std::uint64_t, 8> nodes   = {};
      for (int k = 0; k < element->n_nodes; ++k)
        fields.read(nodes[k]);
      if (element->dimension == dim)
        cells.push_back(nodes);
      else if (element->dimension == dim - 1)
        {
          const std::size_t after = std::min(text.find('\n', end_of_line()), text.size() - 1) + 1;
          faces.push_back({{{nodes[0], nodes[1], nodes[2], nodes[3]}},
                           element->n_nodes,
                           tag,
                           begin_of_line(),
                           after,
                           blocks.size() - 1});
        }
    }

    void Separation::begin_block(const Words &heading, const std::size_t count)
    {
      blocks.push_back({begin_of_line(), end_of_line(), heading, count});
    }

    void Separation::read_elements_2()
    {
      begin_block(read_words("Elements"), 0);
      for (std::uint64_t i = 0; i < blocks[0].heading[0]; ++i)
        {
          GmshFields    fields(lines.entry("Elements"));
          std::uint64_t number = 0;
          int           type = 0, n_tags = 0, tag = 0, other_tag = 0;
          fields.read(number);
          fields.read(type);
          fields.read(n_tags);
          for (int t = 0; t < n_tags; ++t)
            fields.read(t == 0 ? tag : other_tag);
          read_element(fields, type, tag);
        }
    }

    void Separation::read_elements_4()
    {
      begin_block(read_words("Elements"), 1);
      for (std::uint64_t block = 0; block < blocks[0].heading[0]; ++block)
        {
          begin_block(read_words("Elements"), 3);
          const Words heading = blocks.back().heading;
          const auto  tag     = tag_of_entity.find(static_cast<int>(heading.at(1)));
          for (std::uint64_t i = 0; i < heading.at(3); ++i)
            {
              GmshFields    fields(lines.entry("Elements"));
              std::uint64_t number = 0;
              fields.read(number);
              read_element(
                fields, static_cast<int>(heading[2]), tag == tag_of_entity.end() ? 0 : tag->second);
            }
        }
    }

    void Separation::count_cells()
    {
      std::map<Key, unsigned int> n_cells;
      const auto                  key_of_face = [](const Face &face) {
        Key key = face.nodes;
        std::sort(key.begin(), key.end());
        return key;
      };
      for (const Face &face : faces)
        n_cells[key_of_face(face)] = 0;
      const auto count = [&](const Key &key) {
        const auto found = n_cells.find(key);
        if (found != n_cells.end())
          ++found->second;
      };
      for (const auto &cell : cells)
        if (dim == 2)
          for (const auto &side : sides_of_quad)
            count(key_of(cell, side));
        else
          for (const auto &side : sides_of_hex)
            count(key_of(cell, side));
      for (Face &face : faces)
        face.n_cells = n_cells[key_of_face(face)];
    }

    void Separation::check_groups() const
    {
      std::map<int, std::array<std::uint64_t, 2>> n_faces;
      for (const Face &face : faces)
        if (face.tag != 0)
          ++n_faces[face.tag][face.is_inner()];
      for (const auto &[tag, counts] : n_faces)
        if (counts[0] > 0 && counts[1] > 0)
          {
            std::string name = std::to_string(tag);
            for (const auto &named : names)
              if (named.second == tag)
                name = named.first;
            throw InputError("of the physical " + std::string(dim == 2 ? "curve " : "surface ") + name +
                             ", " + std::to_string(counts[1]) + " faces lie inside the body and " +
                             std::to_string(counts[0]) + " on its surface")
              .location(filename)
              .parameter("Mesh/File")
              .hint("make two groups of it: one that bounds the body, one inside");
          }
    }

    std::map<int, std::vector<std::vector<dealii::Point<3>>>> Separation::inner_groups() const
    {
      std::map<int, std::vector<std::vector<dealii::Point<3>>>> result;
      for (const Face &face : faces)
        if (face.is_inner() && face.tag != 0)
          {
            std::vector<dealii::Point<3>> corners;
            for (int k = 0; k < face.n_nodes; ++k)
              corners.push_back(position.at(face.nodes[k]));
            result[face.tag].push_back(corners);
          }
      return result;
    }

    std::string Separation::text_without_inner_faces() const
    {
      std::vector<Block> remaining = blocks;
      std::vector<Edit>  edits;
      for (const Face &face : faces)
        if (face.is_inner())
          {
            edits.push_back({face.begin, face.end, ""});
            --remaining[face.block].heading[remaining[face.block].count];
            if (face.block != 0)
              --remaining[0].heading[remaining[0].count];
          }
      for (const Block &block : remaining)
        {
          std::string heading;
          for (const std::uint64_t word : block.heading)
            heading += (heading.empty() ? "" : " ") + std::to_string(word);
          edits.push_back({block.begin, block.end, heading});
        }
      std::sort(edits.begin(), edits.end(), [](const Edit &a, const Edit &b) { return a.begin < b.begin; });
      std::string result;
      std::size_t done = 0;
      for (const Edit &edit : edits)
        {
          result.append(text, done, edit.begin - done);
          result += edit.text;
          done = edit.end;
        }
      return result.append(text, done, std::string::npos);
    }

    GmshInnerFaces Separation::run()
    {
      lines.next();
      double version = 0;
      lines.read("MeshFormat", version);
      is_version_4 = version == 4.1;
      lines.expect_end("MeshFormat");
      while (lines.next())
        if (lines.line() == "$Entities")
          read_entities();
        else if (lines.line() == "$Nodes")
          read_nodes();
        else if (lines.line() == "$Elements")
          {
            is_version_4 ? read_elements_4() : read_elements_2();
            lines.expect_end("Elements");
          }
        else
          lines.skip_section();
      count_cells();
      check_groups();
      return {inner_groups(), text_without_inner_faces()};
    }
  } // namespace

  GmshInnerFaces take_out_inner_faces(const std::string                &text,
                                      const std::string                &filename,
                                      const int                         dim,
                                      const std::map<std::string, int> &names)
  {
    return Separation(text, filename, dim, names).run();
  }
} // namespace perideal
