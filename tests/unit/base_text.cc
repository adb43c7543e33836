// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/exceptions.h>
#include <strait/base/scene_text.h>
#include <strait/base/text.h>

#include <gtest/gtest.h>

#include <limits>

using namespace strait;

TEST(Text, SplitTrimsAndKeepsEmptyParts)
{
  EXPECT_EQ(split(" a ,b,, c", ','), (std::vector<std::string>{"a", "b", "", "c"}));
  EXPECT_EQ(split("", ','), (std::vector<std::string>{""}));
  EXPECT_EQ(join({"a", "b"}, "/"), "a/b");
}

TEST(Text, NumbersReadBackExactly)
{
  for (const double value : {0.1, 1. / 3., 1e-300, -2.5e17, 0.0078125})
    EXPECT_EQ(std::stod(to_text(value)), value);
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(1.), "1");
}

TEST(Text, NearestNameByEditDistance)
{
  EXPECT_EQ(nearest_name("gpa", {"gas", "Gap"}), "Gap"); // transposed letters
  EXPECT_EQ(nearest_name("gaps", {"grape", "gap"}), "gap");
  EXPECT_EQ(nearest_name("kitten", {"sitting"}), "sitting"); // 3 edits, 7 letters
  EXPECT_EQ(nearest_name("", {"gap"}), "");
}

TEST(Text, NearestNameOnlyIfNear)
{
  const std::vector<std::string> names = {"Viscosity", "Slip length", "Direction"};
  EXPECT_EQ(nearest_name("Viscosty", names), "Viscosity");
  EXPECT_EQ(nearest_name("slip lenght", names), "Slip length");
  EXPECT_EQ(nearest_name("Temperature", names), "");
}

TEST(SceneText, EntriesWithSectionAndLine)
{
  const auto entries = lex_scene(
    "# comment\n"
    "subsection A\n"
    "  set x  y = 1, \\\n"
    "     2   # trailing\n"
    "  SUBSECTION B\n"
    "    set z = p = q\n"
    "  End\n"
    "end\n",
    "f.prm",
    "/there");
  ASSERT_EQ(entries.size(), 4u);
  EXPECT_EQ(entries[0].name, "");
  EXPECT_EQ(entries[1].name, "x y");
  EXPECT_EQ(entries[1].value, "1, 2");
  EXPECT_EQ(entries[1].place, "f.prm:3");
  EXPECT_EQ(entries[1].folder, "/there");
  EXPECT_EQ(entries[3].section, "A/B");
  EXPECT_EQ(entries[3].value, "p = q");
  EXPECT_EQ(entries[3].place, "f.prm:6");
}

namespace
{
  std::string
  parse_error(const std::string &text)
  {
    try
      {
        lex_scene(text, "f.prm", "");
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }
} // namespace

TEST(SceneText, BrokenStructureNamesTheLine)
{
  EXPECT_EQ(parse_error("\nend\n"), "f.prm:2: this 'end' closes no subsection.");
  EXPECT_NE(
    parse_error("subsection A\n").find("f.prm:1: the subsection 'A' is not closed"),
    std::string::npos);
  EXPECT_NE(
    parse_error("subsection A\n x = 1\nend\n").find("f.prm:2: cannot read 'x = 1'"),
    std::string::npos);
  EXPECT_NE(parse_error("set x\n").find("f.prm:1: cannot read"), std::string::npos);
  EXPECT_NE(parse_error("subsection A\nset = 5\nend\n").find("cannot read 'set = 5'"),
            std::string::npos);
  EXPECT_NE(parse_error("\nsubsection A/B\nend\n")
              .find("f.prm:2: the subsection 'A/B' has a '/' in its name"),
            std::string::npos);
}

TEST(SceneText, AParameterIsSetOnceInAFile)
{
  EXPECT_EQ(parse_error("subsection A\n set x = 1, \\\n 2\n\n set x = 3\nend\n"),
            "f.prm:5: 'A/x' was set before in line 2; remove one of them.");
  // Also if the subsection is opened again, and whatever the white space.
  EXPECT_EQ(parse_error("subsection A\n set x y = 1\nend\n"
                        "subsection A\n set x  y = 1\nend\n"),
            "f.prm:5: 'A/x y' was set before in line 2; remove one of them.");
  EXPECT_EQ(parse_error("set x = 1\nset x = 3\n"),
            "f.prm:2: 'x' was set before in line 1; remove one of them.");
  EXPECT_EQ(parse_error("subsection A\n set x = 1\n"
                        " subsection B\n  set x = 2\n end\nend\n"
                        "subsection B\n set x = 3\nend\n"
                        "subsection A\n set y = 4 # set x = 5\nend\n"),
            "none");
}

TEST(SceneText, Overrides)
{
  const SceneEntry entry = lex_override("Contact/Adhesion/Enabled = a=b", "/here");
  EXPECT_EQ(entry.section, "Contact/Adhesion");
  EXPECT_EQ(entry.name, "Enabled");
  EXPECT_EQ(entry.value, "a=b");
  EXPECT_EQ(entry.folder, "/here");
  for (const char *wrong :
       {"Enabled=true", "Contact/Enabled", "", "Contact/=1", "/Size=1"})
    EXPECT_THROW(lex_override(wrong, ""), InputError) << wrong;
}
