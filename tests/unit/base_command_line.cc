// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/command_line.h>
#include <strait/base/exceptions.h>

#include <gtest/gtest.h>

using namespace strait;

namespace
{
  CommandLine
  parse(std::vector<const char *> arguments)
  {
    arguments.insert(arguments.begin(), "strait");
    return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
  }

  std::string
  error_of(const std::vector<const char *> &arguments)
  {
    try
      {
        parse(arguments);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }
} // namespace

TEST(CommandLine, SceneAndOptionsInAnyOrder)
{
  const CommandLine command =
    parse({"--set", "A/b=c", "a.prm", "--quiet", "--output", "out", "--set=A/d=e=f"});
  EXPECT_EQ(command.scene, "a.prm");
  EXPECT_EQ(command.overrides,
            (std::vector<std::string>{"A/b=c", "A/d=e=f", "Output/Directory=out"}));
  EXPECT_TRUE(command.quiet);
  EXPECT_FALSE(command.dry_run);
  EXPECT_EQ(command.text, "");
  EXPECT_TRUE(parse({"a.prm", "--dry-run"}).dry_run);
  EXPECT_TRUE(parse({"a.prm", "--resume"}).resume);
  EXPECT_FALSE(parse({"a.prm"}).resume);
  EXPECT_EQ(parse({"a.prm", "--output=x"}).overrides.back(), "Output/Directory=x");
}

TEST(CommandLine, OptionsThatNeedNoScene)
{
  for (const char *option : {"--help", "-h", "--version", "--scenes"})
    EXPECT_EQ(parse({option}).text, option);
  EXPECT_EQ(parse({"--parameters"}).text, "--parameters");
  EXPECT_EQ(parse({"--parameters"}).format, "prm");
  EXPECT_EQ(parse({"--parameters", "md"}).format, "md");
  EXPECT_EQ(parse({"--parameters=md"}).format, "md");
  EXPECT_EQ(parse({"--columns"}).format, "md");
}

TEST(CommandLine, ScenesThatComeWithIt)
{
  const std::string scenes = list_of_scenes();
  for (const char *line :
       {"\n  quickstart.prm", "\n  given_gap.prm               A pure flow problem\n"})
    EXPECT_NE(scenes.find(line), std::string::npos) << scenes;
}

TEST(CommandLine, WrongUse)
{
  EXPECT_EQ(error_of({"--dryrun", "a.prm"}),
            "Unknown option '--dryrun'; did you mean '--dry-run'?");
  EXPECT_EQ(error_of({"a.prm", "--frobnicate"}),
            "Unknown option '--frobnicate'; see 'strait --help'.");
  for (const std::vector<const char *> &wrong : {std::vector<const char *>{},
                                                 {"--quiet"},
                                                 {"a.prm", "b.prm"},
                                                 {"--parameters", "txt"},
                                                 {"--columns", "csv"},
                                                 {"a.prm", "--set"},
                                                 {"a.prm", "--output"},
                                                 {"a.prm", "--output="},
                                                 {"a.prm", "--quiet=yes"},
                                                 {"a.prm", "--resume=yes"},
                                                 {"--help=md"}})
    EXPECT_NE(error_of(wrong), "none");
}
