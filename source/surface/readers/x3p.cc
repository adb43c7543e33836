// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/binary.h>
#include <strait/surface/readers/formats.h>
#include <strait/surface/readers/text_header.h>

#include <pugixml.hpp>
#include <zip.h>

#include <filesystem>
#include <limits>
#include <memory>

namespace strait
{
  namespace
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();

    /** A zip archive, read entry by entry. */
    class Archive
    {
    public:
      explicit Archive(const std::string &name)
        : file(name)
        , archive(zip_open(name.c_str(), ZIP_RDONLY, nullptr))
      {
        if (archive == nullptr)
          reject_height_map(file, "is a damaged zip archive: copy or export it again.");
      }

      ~Archive()
      {
        zip_discard(archive);
      }

      Archive(const Archive &)            = delete;
      Archive &operator=(const Archive &) = delete;

      /** The content of an entry that may not be longer than @p most bytes. */
      std::string read(const std::string &entry, std::uint64_t most) const;

      const std::string &file;

    private:
      zip_t *archive;
    };

    std::string
    Archive::read(const std::string &entry, const std::uint64_t most) const
    {
      zip_stat_t about;
      zip_stat_init(&about);
      if (zip_stat(archive, entry.c_str(), 0, &about) != 0 ||
          (about.valid & ZIP_STAT_SIZE) == 0)
        reject_height_map(file,
                          "lacks the entry '" + entry +
                            "', so it is no X3P file: export it again.");
      const std::uint64_t possible =
        largest_compression * std::filesystem::file_size(file);
      if (about.size > std::min(most, possible))
        reject_height_map(file,
                          "has an entry '" + entry +
                            "' of an impossible size: copy or export it again.");
      std::string                                              content(about.size, '\0');
      const std::unique_ptr<zip_file_t, int (*)(zip_file_t *)> stream(
        zip_fopen(archive, entry.c_str(), 0), zip_fclose);
      if (!stream || zip_fread(stream.get(), content.data(), about.size) !=
                       static_cast<zip_int64_t>(about.size))
        reject_height_map(file,
                          "cannot be unpacked, its entry '" + entry +
                            "' is damaged: copy or export it again.");
      return content;
    }

    /** The child called @p name, whatever its prefix. */
    pugi::xml_node
    child(const pugi::xml_node &parent, const std::string &name)
    {
      for (const pugi::xml_node node : parent.children())
        {
          const std::string full  = node.name();
          const std::size_t colon = full.find(':');
          if ((colon == std::string::npos ? full : full.substr(colon + 1)) == name)
            return node;
        }
      return {};
    }

    pugi::xml_node
    descend(pugi::xml_node node, std::initializer_list<const char *> path)
    {
      for (const char *name : path)
        node = child(node, name);
      return node;
    }

    std::string
    text_of(const pugi::xml_node &node)
    {
      return trim(node.text().get());
    }

    std::optional<double>
    parse_number(const std::string &text)
    {
      const char       *position = text.data();
      const char *const end      = position + text.size();
      const auto        value    = read_number(position, end);
      return position == end ? value : std::nullopt;
    }

    /** An axis of the first record: number × increment + offset, in metres. */
    struct Axis
    {
      double      increment = 1.;
      double      offset    = 0.;
      std::string data_type;
    };

    Axis
    read_axis(const pugi::xml_node &axes, const char *name, const std::string &file)
    {
      const pugi::xml_node node = child(axes, name);
      if (std::string(name) != "CZ" && text_of(child(node, "AxisType")) != "I")
        reject_height_map(file,
                          std::string("has no axis ") + name +
                            " of regular increments: interpolate it to a regular grid.");
      Axis axis;
      axis.data_type = text_of(child(node, "DataType"));
      axis.increment = parse_number(text_of(child(node, "Increment"))).value_or(1.);
      axis.offset    = parse_number(text_of(child(node, "Offset"))).value_or(0.);
      return axis;
    }

    std::uint64_t
    read_extent(const pugi::xml_node &record, const char *name, const std::string &file)
    {
      const auto value =
        parse_number(text_of(descend(record, {"MatrixDimension", name})));
      if (!value || !(*value >= 0) || *value > 1e9)
        reject_height_map(file,
                          std::string("lacks a matrix dimension ") + name +
                            ", and only matrices are supported: export it as one.");
      return static_cast<std::uint64_t>(*value);
    }

    NumberType
    number_type(const std::string &name, const std::string &file)
    {
      if (name == "I")
        return NumberType::int16;
      if (name == "L")
        return NumberType::int32;
      if (name == "F")
        return NumberType::float32;
      if (name == "D")
        return NumberType::float64;
      reject_height_map(file,
                        "has heights of the unknown type '" + name +
                          "', and known are I, L, F and D: export it again.");
    }

    void
    read_binary(HeightMap            &map,
                const Archive        &archive,
                const pugi::xml_node &link,
                const Axis           &z)
    {
      const auto        n    = static_cast<std::size_t>(map.nx) * map.ny;
      const NumberType  type = number_type(z.data_type, archive.file);
      const std::size_t size = bytes_of(type);
      const std::string bytes =
        archive.read(text_of(child(link, "PointDataLink")), size * n);
      check_claim(archive.file, map.nx, map.ny, size, bytes.size());
      map.values.resize(n);
      for (std::size_t i = 0; i < n; ++i)
        map.values[i] = decode(type, bytes.data() + i * size) * z.increment + z.offset;

      const std::string valid_entry = text_of(child(link, "ValidPointsLink"));
      if (valid_entry.empty())
        return;
      const std::string valid = archive.read(valid_entry, n);
      if (valid.size() < (n + 7) / 8)
        reject_height_map(archive.file,
                          "has too short a list of valid points: export it again.");
      for (std::size_t i = 0; i < n; ++i)
        if ((static_cast<unsigned char>(valid[i / 8]) >> (i % 8) & 1) == 0)
          map.values[i] = none;
    }

    /** Entries "z" or "x;y;z" of a list in the XML; an empty one is missing. */
    void
    read_list(HeightMap            &map,
              const pugi::xml_node &list,
              const Axis           &z,
              const std::string    &file)
    {
      for (const pugi::xml_node datum : list.children())
        {
          if (datum.type() != pugi::node_element)
            continue;
          const std::string text   = text_of(datum);
          const std::string height = trim(text.substr(text.rfind(';') + 1));
          const auto        value  = parse_number(height);
          if (!value && !height.empty())
            reject_height_map(file,
                              "has '" + height.substr(0, 30) +
                                "' among its heights: export it again.");
          map.values.push_back(value ? *value * z.increment + z.offset : none);
        }
      check_claim(file, map.nx, map.ny, 1, map.values.size());
      map.values.resize(static_cast<std::size_t>(map.nx) * map.ny);
    }
  } // namespace

  HeightMap
  read_x3p(const std::string &file)
  {
    const Archive           archive(file);
    constexpr std::uint64_t longest_xml = 1U << 30;
    const std::string       xml         = archive.read("main.xml", longest_xml);
    pugi::xml_document      document;
    if (!document.load_buffer(xml.data(), xml.size()))
      reject_height_map(file, "has a main.xml that is no XML: copy or export it again.");

    const pugi::xml_node root   = child(document, "ISO5436_2");
    const pugi::xml_node record = child(root, "Record3");
    const pugi::xml_node axes   = descend(root, {"Record1", "Axes"});
    const Axis           x = read_axis(axes, "CX", file), y = read_axis(axes, "CY", file),
               z           = read_axis(axes, "CZ", file);
    const std::uint64_t nx = read_extent(record, "SizeX", file),
                        ny = read_extent(record, "SizeY", file);
    if (read_extent(record, "SizeZ", file) != 1)
      reject_height_map(file, "has several layers: export one of them.");
    // Of the claim alone; the entry with the heights is compared with it below.
    check_claim(file, nx, ny, 1, largest_compression * std::filesystem::file_size(file));

    HeightMap map;
    map.nx           = static_cast<int>(nx);
    map.ny           = static_cast<int>(ny);
    map.size         = {{x.increment * map.nx, y.increment * map.ny}};
    map.lateral_unit = {"m", 1.};
    map.height_unit  = {"m", 1.};
    if (const pugi::xml_node link = child(record, "DataLink"))
      read_binary(map, archive, link, z);
    else if (const pugi::xml_node list = child(record, "DataList"))
      read_list(map, list, z, file);
    else
      reject_height_map(file, "holds no heights: export it again.");
    return map;
  }
} // namespace strait
