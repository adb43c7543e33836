// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/surface/readers/formats.h>

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace strait
{
  namespace
  {
    /** An object of the HDF5 library, closed when it goes out of scope. */
    class Handle
    {
    public:
      using Close = herr_t (*)(hid_t);

      Handle(const hid_t id_, Close close_)
        : id(id_)
        , close(close_)
      {
      }

      ~Handle()
      {
        if (id >= 0)
          close(id);
      }

      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;

      bool
      is_valid() const
      {
        return id >= 0;
      }

      operator hid_t() const
      {
        return id;
      }

    private:
      hid_t id;
      Close close;
    };

    /** Keeps the library from printing what we turn into our own messages. */
    class Silence
    {
    public:
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~Silence()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

      Silence(const Silence &)            = delete;
      Silence &operator=(const Silence &) = delete;

    private:
      H5E_auto2_t function = nullptr;
      void       *data     = nullptr;
    };

    bool
    is_number(const hid_t dataset)
    {
      const Handle type(H5Dget_type(dataset), H5Tclose);
      const auto   kind = H5Tget_class(type);
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }

    int
    n_dimensions(const hid_t dataset)
    {
      const Handle space(H5Dget_space(dataset), H5Sclose);
      return H5Sget_simple_extent_ndims(space);
    }

    /** The paths of all two-dimensional data sets of numbers. */
    std::vector<std::string>
    find_maps(const hid_t file)
    {
      std::vector<std::string> paths;
      const auto               visit =
        [](hid_t root, const char *name, const H5O_info_t *info, void *p) {
          if (info->type == H5O_TYPE_DATASET)
            {
              const Handle dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
              if (dataset.is_valid() && n_dimensions(dataset) == 2 && is_number(dataset))
                static_cast<std::vector<std::string> *>(p)->push_back(name);
            }
          return herr_t(0);
        };
      H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &paths, H5O_INFO_BASIC);
      return paths;
    }

    std::string
    choose_map(const hid_t file, const MapSource &source)
    {
      if (!source.dataset.empty())
        return source.dataset;
      const std::vector<std::string> paths = find_maps(file);
      if (paths.empty())
        reject_height_map(source.file,
                          "holds no two-dimensional data set of numbers: check "
                          "Surface/File.");
      if (paths.size() > 1)
        reject_height_map(source.file,
                          "holds several data sets: set Surface/Dataset to one of " +
                            join(paths, ", ") + ".");
      return paths.front();
    }

    std::optional<double>
    number_attribute(const hid_t object, const char *name)
    {
      if (H5Aexists(object, name) <= 0)
        return {};
      const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
      const Handle space(H5Aget_space(attribute), H5Sclose);
      double       value = 0;
      if (H5Sget_simple_extent_npoints(space) != 1 ||
          H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
        return {};
      return value;
    }

    std::string
    text_attribute(const hid_t object, const char *name)
    {
      if (H5Aexists(object, name) <= 0)
        return {};
      const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
      const Handle type(H5Aget_type(attribute), H5Tclose);
      const Handle space(H5Aget_space(attribute), H5Sclose);
      if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
        return {};
      if (H5Tis_variable_str(type) > 0)
        {
          char *text = nullptr;
          if (H5Aread(attribute, type, &text) < 0 || text == nullptr)
            return {};
          const std::string result = text;
          H5free_memory(text);
          return result;
        }
      std::string text(H5Tget_size(type) + 1, '\0');
      if (H5Aread(attribute, type, text.data()) < 0)
        return {};
      return text.substr(0, text.find('\0'));
    }

    /** What the data set, or else the file, says of size and units. */
    void
    read_attributes(HeightMap &map, const hid_t file, const hid_t dataset)
    {
      const Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose);
      const auto   number = [&](const char *name) {
        const auto own = number_attribute(dataset, name);
        return own ? own : number_attribute(root, name);
      };
      const auto text = [&](const char *name) {
        const std::string own = text_attribute(dataset, name);
        return own.empty() ? text_attribute(root, name) : own;
      };
      const auto lx = number("lx"), ly = number("ly");
      const auto dx = number("dx"), dy = number("dy");
      if (lx && ly)
        map.size = {{*lx, *ly}};
      else if (dx && dy)
        map.size = {{*dx * map.nx, *dy * map.ny}};
      map.is_periodic = number("periodic").value_or(0.) != 0.;

      const std::string unit    = text("unit").empty() ? text("units") : text("unit");
      const std::string lateral = text("lateral_unit");
      map.height_unit           = parse_length_unit(unit);
      map.lateral_unit          = parse_length_unit(lateral);
    }

    /**
     * Bytes that the data set can have at most, for what it takes in the file. The
     * library takes the header's word for that, so the length of the file counts too.
     */
    std::uint64_t
    largest_content(const hid_t dataset, const std::string &name)
    {
      const Handle        plan(H5Dget_create_plist(dataset), H5Pclose);
      const std::uint64_t stored =
        std::min<std::uint64_t>(H5Dget_storage_size(dataset),
                                std::filesystem::file_size(name));
      return H5Pget_nfilters(plan) > 0 ? largest_compression * stored : stored;
    }
  } // namespace

  HeightMap
  read_hdf5(const MapSource &source)
  {
    const Silence silence;
    const Handle  file(H5Fopen(source.file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                      H5Fclose);
    if (!file.is_valid())
      reject_height_map(source.file,
                        "is damaged or no HDF5 file: copy or export it again.");
    const std::string path = choose_map(file, source);
    const Handle      dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.is_valid())
      reject_height_map(source.file,
                        "has no data set '" + path + "': set Surface/Dataset to one of " +
                          join(find_maps(file), ", ") + ".");
    if (n_dimensions(dataset) != 2 || !is_number(dataset))
      reject_height_map(source.file,
                        "has a data set '" + path +
                          "' that is not a two-dimensional array of numbers: choose "
                          "another with Surface/Dataset.");
    std::array<hsize_t, 2> extents{};
    {
      const Handle space(H5Dget_space(dataset), H5Sclose);
      H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    }
    const Handle type(H5Dget_type(dataset), H5Tclose);
    check_claim(source.file,
                extents[1],
                extents[0],
                H5Tget_size(type),
                largest_content(dataset, source.file));
    HeightMap map;
    map.ny = static_cast<int>(extents[0]);
    map.nx = static_cast<int>(extents[1]);
    map.values.resize(extents[0] * extents[1]);
    if (H5Dread(
          dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, map.values.data()) <
        0)
      reject_height_map(source.file,
                        "cannot be read to its end: copy or export it again.");
    read_attributes(map, file, dataset);
    return map;
  }
} // namespace strait
