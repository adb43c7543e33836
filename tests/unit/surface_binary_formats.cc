// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/height_map.h>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <netcdf.h>
#include <zip.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <sstream>

#include "surface_test_tools.h"

namespace
{
  using namespace strait;
  using test::input_error;
  using test::mentions;
  using test::TemporaryFile;

  /** A file that a library writes: reserved as an empty one, then filled by rank 0. */
  class WrittenFile : public TemporaryFile
  {
  public:
    explicit WrittenFile(const std::function<void(const std::string &)> &write)
      : TemporaryFile("")
    {
      run_on_root(MPI_COMM_WORLD, [&]() {
        std::filesystem::remove(path);
        write(path);
      });
    }
  };

  HeightMap
  read(const TemporaryFile &file, const std::string &dataset = "")
  {
    return read_height_map({file.path, MapFormat::by_content, dataset});
  }

  std::string
  complaint(const TemporaryFile &file, const std::string &dataset = "")
  {
    return input_error([&]() { read(file, dataset); });
  }

  std::string
  content_of(const TemporaryFile &file)
  {
    std::ifstream      stream(file.path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /** Cut at 10 … 90 % of its length a file must be refused, never crash. */
  void
  expect_refusal_when_cut(const TemporaryFile &file)
  {
    const std::string whole = content_of(file);
    for (int tenths = 1; tenths < 10; ++tenths)
      {
        const TemporaryFile cut(whole.substr(0, whole.size() * tenths / 10));
        EXPECT_FALSE(complaint(cut).empty()) << tenths;
      }
  }

  // NetCDF

  struct NetcdfContent
  {
    int                 mode       = NC_64BIT_OFFSET;
    nc_type             type       = NC_DOUBLE;
    std::string         name       = "heights";
    std::string         outer_name = "x";
    std::string         inner_name = "y";
    std::vector<double> values     = {1, 2, 3, 4, 5, 6}; // 3 outer, 2 inner
    bool                has_sides  = true;
    const char         *unit       = "nm";
    double              fill       = 0.; // 0: none
  };

  void
  write_netcdf_file(const std::string &path, const NetcdfContent &content)
  {
    int file = 0, heights = 0;
    ASSERT_EQ(nc_create(path.c_str(), content.mode, &file), NC_NOERR);
    int dimensions[2];
    nc_def_dim(file, content.outer_name.c_str(), 3, &dimensions[0]);
    nc_def_dim(file, content.inner_name.c_str(), 2, &dimensions[1]);
    nc_def_var(file, content.name.c_str(), content.type, 2, dimensions, &heights);
    nc_put_att_text(file, heights, "unit", std::strlen(content.unit), content.unit);
    if (content.fill != 0.)
      nc_put_att_double(file, heights, "_FillValue", content.type, 1, &content.fill);
    for (int d = 0; content.has_sides && d < 2; ++d)
      {
        int          side   = 0;
        const double length = d == 0 ? 30. : 40.;
        const int    one    = 1;
        const auto  &name   = d == 0 ? content.outer_name : content.inner_name;
        nc_def_var(file, name.c_str(), NC_DOUBLE, 1, &dimensions[d], &side);
        nc_put_att_text(file, side, "unit", 2, "um");
        nc_put_att_double(file, side, "length", NC_DOUBLE, 1, &length);
        nc_put_att_int(file, side, "periodic", NC_INT, 1, &one);
      }
    nc_enddef(file);
    nc_put_var_double(file, heights, content.values.data());
    ASSERT_EQ(nc_close(file), NC_NOERR);
  }

  WrittenFile
  netcdf(const NetcdfContent &content = {})
  {
    return WrittenFile(
      [&](const std::string &path) { write_netcdf_file(path, content); });
  }

  TEST(NetcdfReader, LayoutOfContactEngineering)
  {
    for (const int mode : {NC_CLASSIC_MODEL, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4})
      {
        NetcdfContent content;
        content.mode   = mode;
        const auto map = read(netcdf(content));
        EXPECT_EQ(map.nx, 3);
        EXPECT_EQ(map.ny, 2);
        EXPECT_EQ(map.values, (std::vector<double>{1, 3, 5, 2, 4, 6}));
        ASSERT_TRUE(map.size);
        EXPECT_DOUBLE_EQ((*map.size)[0], 30.);
        EXPECT_DOUBLE_EQ((*map.size)[1], 40.);
        EXPECT_DOUBLE_EQ(map.lateral_unit.metres.value(), 1e-6);
        EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-9);
        EXPECT_TRUE(map.is_periodic);
        EXPECT_EQ(map.format, "NetCDF");
      }
  }

  TEST(NetcdfReader, OtherDimensionsAndFillValues)
  {
    NetcdfContent content;
    content.outer_name = "row";
    content.inner_name = "column";
    content.has_sides  = false;
    content.name       = "z";
    content.type       = NC_SHORT;
    content.fill       = -7.;
    content.values[1]  = -7.;
    const auto map     = read(netcdf(content));
    EXPECT_EQ(map.nx, 2);
    EXPECT_EQ(map.ny, 3);
    EXPECT_FALSE(map.size);
    EXPECT_EQ(map.n_missing(), 1U);
    EXPECT_TRUE(std::isnan(map.values[1]));
    EXPECT_EQ(map.values[5], 6.);
    EXPECT_EQ(read(netcdf(content), "z").nx, 2);
    EXPECT_TRUE(mentions(complaint(netcdf(content), "h"), "one of z"));
  }

  TEST(NetcdfReader, BadFiles)
  {
    NetcdfContent classic;
    expect_refusal_when_cut(netcdf(classic));
    NetcdfContent hdf5;
    hdf5.mode = NC_NETCDF4;
    expect_refusal_when_cut(netcdf(hdf5));

    NetcdfContent empty;
    empty.values.assign(6, NAN);
    EXPECT_TRUE(mentions(complaint(netcdf(empty)), "no valid point"));
    NetcdfContent text;
    text.type = NC_CHAR;
    EXPECT_TRUE(mentions(complaint(netcdf(text)), "no two-dimensional variable"));

    // The extents that a damaged classic header claims, 2^30 in place of 3.
    std::string       whole = content_of(netcdf(classic));
    const std::size_t at    = whole.find(std::string("\0\0\0\1x\0\0\0", 8)) + 8;
    whole[at]               = '\x40';
    EXPECT_TRUE(mentions(complaint(TemporaryFile(whole)), "height map"));
  }

  // HDF5

  struct Hdf5Content
  {
    std::vector<std::string> paths   = {"/group/map"};
    std::vector<hsize_t>     extents = {2, 3};
    hid_t                    type    = H5T_IEEE_F32LE;
    std::vector<double>      values  = {1, 2, 3, 4, 5, 6};
    bool                     written = true;
  };

  void
  write_hdf5_file(const std::string &path, const Hdf5Content &content)
  {
    const hid_t file  = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const int   rank  = static_cast<int>(content.extents.size());
    const hid_t space = H5Screate_simple(rank, content.extents.data(), nullptr);
    const hid_t one   = H5Screate(H5S_SCALAR);
    const hid_t text  = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 2);
    for (const std::string &name : content.paths)
      {
        const hid_t set = H5Dcreate2(
          file, name.c_str(), content.type, space, links, H5P_DEFAULT, H5P_DEFAULT);
        if (content.written)
          H5Dwrite(
            set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.values.data());
        const hid_t unit = H5Acreate2(set, "unit", text, one, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(unit, text, "um");
        H5Aclose(unit);
        for (const std::string side : {"lx", "ly"})
          {
            const double length = side == "lx" ? 3. : 2.;
            const hid_t  a      = H5Acreate2(
              set, side.c_str(), H5T_IEEE_F64LE, one, H5P_DEFAULT, H5P_DEFAULT);
            H5Awrite(a, H5T_NATIVE_DOUBLE, &length);
            H5Aclose(a);
          }
        H5Dclose(set);
      }
    H5Tclose(text);
    H5Sclose(one);
    H5Sclose(space);
    H5Pclose(links);
    H5Fclose(file);
  }

  WrittenFile
  hdf5(const Hdf5Content &content = {})
  {
    return WrittenFile([&](const std::string &path) { write_hdf5_file(path, content); });
  }

  TEST(Hdf5Reader, AnyDatasetWithItsAttributes)
  {
    const auto map = read(hdf5());
    EXPECT_EQ(map.nx, 3);
    EXPECT_EQ(map.ny, 2);
    EXPECT_EQ(map.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1e-6);
    EXPECT_DOUBLE_EQ((*map.size)[0], 3.);
    EXPECT_FALSE(map.lateral_unit.is_stated());
    EXPECT_EQ(map.format, "HDF5");

    Hdf5Content two;
    two.paths = {"/a/map", "/b"};
    two.type  = H5T_STD_I16BE;
    EXPECT_EQ(read(hdf5(two), "/a/map").values[5], 6.);
    EXPECT_EQ(read(hdf5(two), "b").values[5], 6.);
  }

  TEST(Hdf5Reader, BadFiles)
  {
    Hdf5Content two;
    two.paths = {"/a", "/b"};
    EXPECT_TRUE(mentions(complaint(hdf5(two)), "one of a, b"));
    EXPECT_TRUE(mentions(complaint(hdf5(two), "c"), "no data set 'c'"));
    Hdf5Content flat;
    flat.extents = {6};
    EXPECT_TRUE(mentions(complaint(hdf5(flat)), "no two-dimensional"));
    EXPECT_TRUE(mentions(complaint(hdf5(flat), "/group/map"), "not a two-dimensional"));
    Hdf5Content claim;
    claim.extents = {60000, 60000};
    claim.written = false;
    EXPECT_TRUE(mentions(complaint(hdf5(claim)), "too short"));
    claim.extents = {1000000, 1000000};
    EXPECT_TRUE(mentions(complaint(hdf5(claim)), "between 1 and"));
    Hdf5Content empty;
    empty.values.assign(6, NAN);
    EXPECT_TRUE(mentions(complaint(hdf5(empty)), "no valid point"));
    expect_refusal_when_cut(hdf5());
  }

  // X3P

  struct X3pContent
  {
    std::string nx        = "3";
    std::string type      = "I";
    std::string axis_type = "I";
    std::string heights   = std::string("\1\0\2\0\3\0\4\0\5\0\xfa\xff", 12);
    std::string valid; // empty: no such entry
    std::string list;  // replaces the binary entry
    std::string xml_end = "</p:ISO5436_2>";
  };

  void
  add_entry(zip_t *archive, const char *name, const std::string &content)
  {
    char *copy = static_cast<char *>(std::malloc(content.size() + 1));
    std::memcpy(copy, content.data(), content.size());
    zip_file_add(archive,
                 name,
                 zip_source_buffer(archive, copy, content.size(), 1),
                 ZIP_FL_OVERWRITE);
  }

  void
  write_x3p_file(const std::string &path, const X3pContent &content)
  {
    const auto axis = [&](const std::string &name, const std::string &inner) {
      return "<" + name + ">" + inner + "</" + name + ">";
    };
    std::string xml =
      "<?xml version=\"1.0\"?><p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/"
      "ISO5436_2\"><Record1><Axes>" +
      axis("CX",
           "<AxisType>" + content.axis_type +
             "</AxisType><Increment>1e-6</Increment><Offset>0</Offset>") +
      axis("CY", "<AxisType>I</AxisType><Increment>2e-6</Increment>") +
      axis("CZ",
           "<AxisType>A</AxisType><DataType>" + content.type +
             "</DataType><Increment>1e-9</Increment><Offset>1e-7</Offset>") +
      "</Axes></Record1><Record3><MatrixDimension><SizeX>" + content.nx +
      "</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>";
    if (!content.list.empty())
      xml += "<DataList>" + content.list + "</DataList>";
    else
      xml += "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>" +
             std::string(content.valid.empty()
                           ? ""
                           : "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>") +
             "</DataLink>";
    xml += "</Record3>" + content.xml_end;

    zip_t *archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    ASSERT_NE(archive, nullptr);
    add_entry(archive, "main.xml", xml);
    if (content.list.empty())
      add_entry(archive, "bindata/data.bin", content.heights);
    if (!content.valid.empty())
      add_entry(archive, "bindata/valid.bin", content.valid);
    ASSERT_EQ(zip_close(archive), 0);
  }

  WrittenFile
  x3p(const X3pContent &content = {})
  {
    return WrittenFile([&](const std::string &path) { write_x3p_file(path, content); });
  }

  template <class Number>
  std::string
  bytes(const std::vector<Number> &numbers)
  {
    std::string result(numbers.size() * sizeof(Number), '\0');
    std::memcpy(result.data(), numbers.data(), result.size());
    return result;
  }

  TEST(X3pReader, Types)
  {
    X3pContent content;
    for (const std::string type : {"I", "L", "F", "D"})
      {
        content.type = type;
        if (type == "L")
          content.heights = bytes<int>({1, 2, 3, 4, 5, -6});
        if (type == "F")
          content.heights = bytes<float>({1, 2, 3, 4, 5, -6});
        if (type == "D")
          content.heights = bytes<double>({1, 2, 3, 4, 5, -6});
        const auto map = read(x3p(content));
        EXPECT_EQ(map.nx, 3);
        EXPECT_EQ(map.ny, 2);
        EXPECT_DOUBLE_EQ(map.values[0], 1.01e-7);
        EXPECT_DOUBLE_EQ(map.values[5], 0.94e-7);
        EXPECT_DOUBLE_EQ((*map.size)[0], 3e-6);
        EXPECT_DOUBLE_EQ((*map.size)[1], 4e-6);
        EXPECT_DOUBLE_EQ(map.height_unit.metres.value(), 1.);
      }
  }

  TEST(X3pReader, MissingPointsAndLists)
  {
    X3pContent masked;
    masked.valid   = "\x37"; // all but the fourth
    const auto map = read(x3p(masked));
    EXPECT_EQ(map.n_missing(), 1U);
    EXPECT_TRUE(std::isnan(map.values[3]));

    X3pContent list;
    list.list =
      "<Datum>1</Datum><Datum>0;0;2</Datum><Datum/><Datum>4</Datum>"
      "<Datum>5</Datum><Datum>6</Datum>";
    const auto listed = read(x3p(list));
    EXPECT_DOUBLE_EQ(listed.values[1], 1.02e-7);
    EXPECT_TRUE(std::isnan(listed.values[2]));
  }

  TEST(X3pReader, BadFiles)
  {
    const auto complaint_of = [](auto change) {
      X3pContent content;
      change(content);
      return complaint(x3p(content));
    };
    EXPECT_TRUE(
      mentions(complaint_of([](auto &c) { c.heights.resize(11); }), "too short"));
    EXPECT_TRUE(
      mentions(complaint_of([](auto &c) { c.heights.resize(50); }), "impossible"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) { c.nx = "60000"; }), "too short"));
    EXPECT_TRUE(
      mentions(complaint_of([](auto &c) { c.nx = "1000000000"; }), "between 1 and"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) { c.nx = "three"; }), "SizeX"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) { c.type = "Q"; }), "type 'Q'"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) { c.axis_type = "A"; }), "axis CX"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) { c.xml_end = "<"; }), "no XML"));
    EXPECT_TRUE(mentions(complaint_of([](auto &c) {
                           c.type    = "D";
                           c.heights = bytes<double>(std::vector<double>(6, NAN));
                         }),
                         "no valid point"));
    EXPECT_TRUE(mentions(complaint(WrittenFile([](const std::string &path) {
                           zip_t *archive = zip_open(path.c_str(), ZIP_CREATE, nullptr);
                           add_entry(archive, "letter.txt", "no map");
                           zip_close(archive);
                         })),
                         "no X3P file"));
    expect_refusal_when_cut(x3p());
  }
} // namespace
