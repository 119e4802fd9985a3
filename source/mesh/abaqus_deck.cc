// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/abaqus_deck.h>
#include <perideal/mesh/abaqus_lines.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace perideal
{
  namespace
  {
    /// An element type: its dimension and its number of nodes, by the beginning of its name.
    struct AbaqusElementType
    {
      std::string  name;
      unsigned int dimension, n_nodes;
    };

    const AbaqusElementType *element_type(const std::string &name)
    {
      // Abaqus manual, "Element library"; what may follow are variants: reduced integration (R), incompatible
      // modes (I), hybrid (H), temperature (T).
      static const std::vector<AbaqusElementType> types = {{"CPS4", 2, 4},
                                                           {"CPE4", 2, 4},
                                                           {"S4", 2, 4},
                                                           {"M3D4", 2, 4},
                                                           {"SFM3D4", 2, 4},
                                                           {"R3D4", 2, 4},
                                                           {"C3D8", 3, 8},
                                                           {"T2D2", 1, 2},
                                                           {"T3D2", 1, 2},
                                                           {"B21", 1, 2},
                                                           {"B31", 1, 2},
                                                           {"R2D2", 1, 2}};
      for (const AbaqusElementType &type : types)
        if (name.rfind(type.name, 0) == 0 && std::all_of(name.begin() + type.name.size(),
                                                         name.end(),
                                                         [](const char c) { return std::isalpha(c) != 0; }))
          return &type;
      return nullptr;
    }

    /// One walk through a file.
    class DeckReader
    {
    public:
      DeckReader(const std::string &text, const std::string &filename)
        : lines(text, filename)
      {
      }

      AbaqusDeck run();

    private:
      using Words = AbaqusLines::Words;

      void refuse_generated() const;
      void read_nodes();
      void read_elements();
      void read_set(const std::string &keyword, AbaqusNames<std::vector<std::uint64_t>> &sets);
      void read_surface();
      void read_instance();
      void add_nodes_of_elements(const std::string &set, std::vector<std::uint64_t> &members) const;
      void move_nodes();

      template <typename Entry>
      static Entry &entry_of(AbaqusNames<Entry> &list, const std::string &name);
      template <typename Entry>
      static const Entry *find(const AbaqusNames<Entry> &list, const std::string &name);

      AbaqusLines             lines;
      unsigned int            n_parts = 0, n_instances = 0;
      std::array<double, 3>   translation{};
      std::set<std::uint64_t> element_numbers;
      AbaqusDeck              deck;
    };

    template <typename Entry>
    Entry &DeckReader::entry_of(AbaqusNames<Entry> &list, const std::string &name)
    {
      for (auto &entry : list)
        if (in_capitals(entry.first) == in_capitals(name))
          return entry.second;
      list.emplace_back(name, Entry());
      return list.back().second;
    }

    template <typename Entry>
    const Entry *DeckReader::find(const AbaqusNames<Entry> &list, const std::string &name)
    {
      // "Part-1-1.TOP" is the set TOP of an instance.
      const std::size_t dot = name.rfind('.');
      for (const auto &entry : list)
        if (in_capitals(entry.first) == in_capitals(name.substr(dot == std::string::npos ? 0 : dot + 1)))
          return &entry.second;
      return nullptr;
    }

    void DeckReader::refuse_generated() const
    {
      static const std::set<std::string> generators = {
        "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "INCLUDE"};
      if (generators.count(lines.keyword()) > 0)
        lines.fail("the keyword *" + lines.keyword() +
                     " is not supported: nodes and elements must stand in the file itself",
                   "write the mesh out with Abaqus/CAE (Write Input) or a converter: meshio convert part.inp "
                   "part.msh --output-format gmsh22");
    }

    void DeckReader::read_nodes()
    {
      const std::string          set = lines.option("NSET");
      std::vector<std::uint64_t> members;
      lines.visit_data([&](const Words &words) {
        const std::uint64_t   number = lines.number_of(words.front(), "a node");
        std::array<double, 3> x{};
        for (std::size_t d = 0; d < 3 && d + 1 < words.size(); ++d)
          x[d] = lines.coordinate_of(words[d + 1]);
        if (!deck.nodes.emplace(number, x).second)
          lines.fail("node " + std::to_string(number) + " is given twice");
        members.push_back(number);
      });
      if (!set.empty())
        {
          auto &all = entry_of(deck.node_sets, set);
          all.insert(all.end(), members.begin(), members.end());
        }
    }

    void DeckReader::read_elements()
    {
      const std::string        name = in_capitals(lines.option("TYPE")), set = lines.option("ELSET");
      const AbaqusElementType *type = element_type(name);
      if (type == nullptr)
        lines.fail(
          "elements of type " + (name.empty() ? "(none given)" : name) +
            " are not supported; the mesh must consist of quadrilaterals (CPS4, CPE4) or hexahedra "
            "(C3D8), with nodes at "
            "their corners only, of whatever variant (R, I, H)",
          "mesh the part with these elements in Abaqus/CAE: Mesh > Controls > Quad or Hex, Element Type > "
          "Linear");
      std::vector<std::uint64_t> members, numbers;
      std::size_t                begin = 0;
      lines.visit_data([&](const Words &words) {
        if (numbers.empty())
          begin = lines.line_number();
        for (const std::string &word : words)
          if (!word.empty())
            numbers.push_back(lines.number_of(word, numbers.empty() ? "an element" : "a node"));
        if (numbers.size() < type->n_nodes + 1 && lines.goes_on())
          return; // it goes on in the next line
        if (numbers.size() != type->n_nodes + 1)
          lines.fail("an element of type " + name + " has " + std::to_string(type->n_nodes) +
                     " nodes, this one " + std::to_string(numbers.size() - 1));
        if (!element_numbers.insert(numbers.front()).second)
          lines.fail("element " + std::to_string(numbers.front()) + " is given twice");
        deck.elements[type->dimension].push_back(
          {numbers.front(), {numbers.begin() + 1, numbers.end()}, begin});
        members.push_back(numbers.front());
        numbers.clear();
      });
      if (!numbers.empty())
        lines.fail("the last element of type " + name + " ends before its nodes do");
      if (!set.empty())
        {
          auto &all = entry_of(deck.element_sets, set);
          all.insert(all.end(), members.begin(), members.end());
        }
    }

    void DeckReader::add_nodes_of_elements(const std::string &set, std::vector<std::uint64_t> &members) const
    {
      const auto *elements = find(deck.element_sets, set);
      if (elements == nullptr)
        lines.fail("there is no element set " + set + " before this line");
      const std::set<std::uint64_t> wanted(elements->begin(), elements->end());
      for (const auto &of_dimension : deck.elements)
        for (const AbaqusElement &element : of_dimension)
          if (wanted.count(element.number) > 0)
            members.insert(members.end(), element.nodes.begin(), element.nodes.end());
    }

    void DeckReader::read_set(const std::string &name_option, AbaqusNames<std::vector<std::uint64_t>> &sets)
    {
      const std::string name = lines.option(name_option);
      if (name.empty())
        lines.fail("a set needs a name: *" + lines.keyword() + ", " + name_option + "=NAME");
      const bool                 is_generated = lines.has_option("GENERATE");
      std::vector<std::uint64_t> members;
      if (&sets == &deck.node_sets && !lines.option("ELSET").empty())
        add_nodes_of_elements(lines.option("ELSET"), members);
      lines.visit_data([&](const Words &words) {
        if (is_generated)
          {
            const std::uint64_t first = lines.number_of(words.at(0), "a set"),
                                last  = words.size() > 1 ? lines.number_of(words[1], "a set") : first,
                                step  = words.size() > 2 && !words[2].empty() ?
                                          lines.number_of(words[2], "a set") :
                                          1;
            if (step == 0 || last < first)
              lines.fail("a set is generated from its first to its last number by steps of 1 or more");
            for (std::uint64_t number = first; number <= last; number += step)
              members.push_back(number);
            return;
          }
        for (const std::string &word : words)
          if (word.empty())
            continue;
          else if (std::isdigit(static_cast<unsigned char>(word.front())) != 0)
            members.push_back(lines.number_of(word, "a set"));
          else if (const auto *other = find(sets, word))
            members.insert(members.end(), other->begin(), other->end());
          else
            lines.fail("there is no set " + word + " before this line");
      });
      auto &all = entry_of(sets, name);
      all.insert(all.end(), members.begin(), members.end());
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }

    void DeckReader::read_surface()
    {
      const std::string name = lines.option("NAME"), type = in_capitals(lines.option("TYPE"));
      if (name.empty() || lines.has_option("COMBINE") ||
          (!type.empty() && type != "ELEMENT" && type != "NODE"))
        {
          lines.visit_data([](const Words &) {});
          return;
        }
      lines.visit_data([&](const Words &words) {
        const std::string &of = words.front();
        const bool is_number  = !of.empty() && std::isdigit(static_cast<unsigned char>(of.front())) != 0;
        if (type == "NODE")
          {
            const auto                      *set = find(deck.node_sets, of);
            const std::vector<std::uint64_t> members =
              set != nullptr ? *set :
              is_number      ? std::vector<std::uint64_t>{lines.number_of(of, "a node")} :
                               std::vector<std::uint64_t>();
            if (members.empty())
              lines.fail("there is no node set " + of + " before this line");
            auto &all = entry_of(deck.node_sets, name);
            all.insert(all.end(), members.begin(), members.end());
            return;
          }
        AbaqusSides sides;
        const auto *set = find(deck.element_sets, of);
        if (set == nullptr && !is_number)
          lines.fail("there is no element set " + of + " before this line");
        sides.elements =
          set != nullptr ? *set : std::vector<std::uint64_t>{lines.number_of(of, "an element")};
        const std::string label  = words.size() > 1 ? in_capitals(words[1]) : "";
        const bool        is_one = label.size() == 2 && label[0] == 'S' && label[1] >= '1' && label[1] <= '6';
        // The two faces of a shell or membrane are no sides of a solid.
        if (!label.empty() && !is_one)
          lines.fail("'" + words[1] + "' is no side of a solid element: S1 to S6");
        sides.side = is_one ? label[1] - '0' : 0;
        entry_of(deck.surfaces, name).push_back(sides);
      });
    }

    void DeckReader::read_instance()
    {
      if (++n_instances > 1)
        lines.fail("the assembly has more than one instance; a scene is one part",
                   "merge the instances in Abaqus/CAE (Instance > Merge/Cut)");
      unsigned int n_lines = 0;
      lines.visit_data([&](const Words &words) {
        if (++n_lines > 1)
          lines.fail("the instance is turned, which is not supported", "write the part as it stands");
        for (std::size_t d = 0; d < 3 && d < words.size(); ++d)
          translation[d] = lines.coordinate_of(words[d]);
      });
    }

    void DeckReader::move_nodes()
    {
      for (auto &node : deck.nodes)
        for (int d = 0; d < 3; ++d)
          node.second[d] += translation[d];
    }

    AbaqusDeck DeckReader::run()
    {
      while (lines.next_keyword())
        {
          const std::string &keyword = lines.keyword();
          refuse_generated();
          if (keyword == "PART" && ++n_parts > 1)
            lines.fail("the file has more than one part; a scene is one part",
                       "write each part to a file of its own");
          if (keyword == "NODE")
            read_nodes();
          else if (keyword == "ELEMENT")
            read_elements();
          else if (keyword == "NSET")
            read_set("NSET", deck.node_sets);
          else if (keyword == "ELSET")
            read_set("ELSET", deck.element_sets);
          else if (keyword == "SURFACE")
            read_surface();
          else if (keyword == "INSTANCE")
            read_instance();
          else
            {
              if (keyword == "SOLID SECTION" && !lines.option("ELSET").empty())
                deck.sections.push_back(lines.option("ELSET"));
              lines.visit_data([](const Words &) {});
            }
        }
      move_nodes();
      return std::move(deck);
    }
  } // namespace

  AbaqusDeck read_abaqus_deck(const std::string &text, const std::string &filename)
  {
    return DeckReader(text, filename).run();
  }
} // namespace perideal
