// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <zip.h>

#include <cmath>
#include <cstring>

#include "surface_format_tools.h"

namespace
{
  using namespace strait;
  using namespace strait::test;

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
