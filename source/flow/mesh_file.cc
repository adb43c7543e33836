// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/flow/seal_mesh.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

namespace strait
{
  namespace
  {
    // Gmsh's codes of element types, and their numbers of nodes.
    constexpr int            line = 1, triangle = 2, quadrilateral = 3, point = 15;
    const std::map<int, int> n_nodes_of = {{line, 2}, {quadrilateral, 4}, {point, 1}};
    const char *const        how_to_write =
      "; write it with 'gmsh -2 -format msh41', all quadrilaterals";

    class Parser
    {
    public:
      Parser(const std::string &text, const std::string &name_)
        : in(text)
        , length(text.size())
        , name(name_)
      {
      }

      MeshFile
      parse()
      {
        read_format();
        std::string header;
        while (in >> header)
          if (header == "$Entities")
            read_entities();
          else if (header == "$Nodes")
            read_nodes();
          else if (header == "$Elements")
            read_elements();
          else
            skip(header);
        if (mesh.quadrilaterals.empty())
          fail("holds no quadrilaterals");
        return std::move(mesh);
      }

    private:
      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("The mesh '" + name + "' " + what + how_to_write + ".");
      }

      template <class Number>
      Number
      next(const std::string &what)
      {
        Number value;
        if (!(in >> value))
          fail("breaks off or is no number where " + what + " should be");
        return value;
      }

      std::size_t
      next_count(const std::string &what)
      {
        const auto count = next<long long>(what);
        // A damaged file must not ask for all memory: no count exceeds the file's length.
        if (count < 0 || static_cast<std::size_t>(count) > length)
          fail("says that " + what + " is " + std::to_string(count));
        return static_cast<std::size_t>(count);
      }

      void
      end(const std::string &section)
      {
        std::string word;
        if (!(in >> word) || word != "$End" + section)
          fail("does not end $" + section + " where it should");
      }

      void
      skip(const std::string &header)
      {
        if (header.size() < 2 || header.front() != '$')
          fail("holds '" + header.substr(0, 20) + "' where a section should begin");
        const std::string last = "$End" + header.substr(1);
        std::string       word;
        while (in >> word)
          if (word == last)
            return;
        fail("does not end " + header);
      }

      void
      read_format()
      {
        std::string header;
        if (!(in >> header) || header != "$MeshFormat")
          fail("is no Gmsh file");
        const auto version = next<std::string>("the version of the format");
        if (version != "4.1")
          fail("has the format " + version.substr(0, 20) + " instead of 4.1");
        if (next<int>("the kind of file") != 0)
          fail("is binary instead of ASCII");
        next<int>("the size of numbers");
        end("MeshFormat");
      }

      /** Entities have bounding boxes, physical groups and, except for points, bounding
       *  entities. The first physical group of each curve is kept. */
      void
      read_entities()
      {
        std::array<std::size_t, 4> counts = {};
        for (std::size_t &count : counts)
          count = next_count("the number of entities");
        for (std::size_t dim = 0; dim < counts.size(); ++dim)
          for (std::size_t k = 0; k < counts[dim]; ++k)
            {
              const auto tag = next<int>("an entity");
              for (int c = 0; c < (dim == 0 ? 3 : 6); ++c)
                next<double>("the place of an entity");
              const std::size_t n_groups = next_count("the number of physical groups");
              for (std::size_t g = 0; g < n_groups; ++g)
                {
                  const auto id = next<int>("a physical group");
                  // Its sign is the orientation of the curve in the group.
                  if (dim == 1)
                    boundary_ids.emplace(tag, std::abs(id));
                }
              if (dim == 0)
                continue;
              const std::size_t n_bounds = next_count("the number of bounding entities");
              for (std::size_t b = 0; b < n_bounds; ++b)
                next<int>("a bounding entity");
            }
        end("Entities");
      }

      void
      read_nodes()
      {
        const std::size_t n_blocks = next_count("the number of node blocks");
        for (int k = 0; k < 3; ++k)
          next_count("a number of nodes");
        for (std::size_t block = 0; block < n_blocks; ++block)
          {
            next<int>("the dimension of an entity");
            next<int>("an entity");
            if (next<int>("whether nodes are parametric") != 0)
              fail("holds parametric nodes");
            const std::size_t      n = next_count("the number of nodes of a block");
            std::vector<long long> tags;
            for (std::size_t k = 0; k < n; ++k)
              tags.push_back(next<long long>("a node"));
            for (const long long tag : tags)
              {
                std::array<double, 3> x = {};
                for (double &coordinate : x)
                  coordinate = next<double>("a coordinate");
                if (!std::isfinite(x[0] + x[1]) || x[2] != 0.)
                  fail("has node " + std::to_string(tag) + " off the plane z = 0");
                nodes[tag] = {x[0], x[1]};
              }
          }
        end("Nodes");
      }

      /** Return the new number of a node; give it one if it has none. */
      unsigned int
      point_number(const long long tag)
      {
        const auto node = nodes.find(tag);
        if (node == nodes.end())
          fail("has an element with the unknown node " + std::to_string(tag));
        const auto [entry, is_new] =
          numbers.emplace(tag, static_cast<unsigned int>(mesh.points.size()));
        if (is_new)
          mesh.points.push_back(node->second);
        return entry->second;
      }

      void
      read_elements()
      {
        const std::size_t n_blocks = next_count("the number of element blocks");
        for (int k = 0; k < 3; ++k)
          next_count("a number of elements");
        for (std::size_t block = 0; block < n_blocks; ++block)
          {
            next<int>("the dimension of an entity");
            const auto        entity = next<int>("an entity");
            const auto        type   = next<int>("the type of elements");
            const std::size_t n      = next_count("the number of elements of a block");
            if (type == triangle)
              fail("holds triangles (Recombine Surface makes quadrilaterals)");
            const auto known = n_nodes_of.find(type);
            if (known == n_nodes_of.end())
              fail("holds elements of the type " + std::to_string(type) +
                   " besides straight lines and quadrilaterals");
            for (std::size_t k = 0; k < n; ++k)
              read_element(type, known->second, entity);
          }
        end("Elements");
      }

      void
      read_element(const int type, const int n_nodes, const int entity)
      {
        next<long long>("the number of an element");
        std::array<long long, 4> tags = {};
        for (int v = 0; v < n_nodes; ++v)
          tags[v] = next<long long>("a node of an element");
        if (type == quadrilateral)
          {
            std::array<unsigned int, 4> corners = {};
            for (std::size_t v = 0; v < corners.size(); ++v)
              corners[v] = point_number(tags[v]);
            mesh.quadrilaterals.push_back(corners);
          }
        else if (type == line)
          {
            const auto id = boundary_ids.find(entity);
            mesh.lines.push_back({{{point_number(tags[0]), point_number(tags[1])}},
                                  entity,
                                  id == boundary_ids.end() ? -1 : id->second});
          }
      }

      std::istringstream                    in;
      std::size_t                           length;
      std::string                           name;
      MeshFile                              mesh;
      std::map<int, int>                    boundary_ids; // of curves
      std::map<long long, dealii::Point<2>> nodes;
      std::map<long long, unsigned int>     numbers;
    };
  } // namespace

  MeshFile
  parse_mesh_file(const std::string &text, const std::string &name)
  {
    return Parser(text, name).parse();
  }
} // namespace strait
