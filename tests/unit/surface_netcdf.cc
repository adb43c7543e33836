// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <cstring>

#include "surface_format_tools.h"

namespace
{
  using namespace strait;
  using namespace strait::test;

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
} // namespace
