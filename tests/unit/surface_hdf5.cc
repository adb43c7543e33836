// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <cstring>

#include "surface_format_tools.h"

namespace
{
  using namespace strait;
  using namespace strait::test;

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
} // namespace
