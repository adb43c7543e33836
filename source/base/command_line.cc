// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/command_line.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

namespace strait
{
  namespace
  {
    const std::map<std::string, bool CommandLine::*> flags = {
      {"--resume", &CommandLine::resume},
      {"--force", &CommandLine::force},
      {"--dry-run", &CommandLine::dry_run},
      {"--quiet", &CommandLine::quiet}};

    /** The options that print a text, with the formats of each, the default first. */
    const std::map<std::string, std::vector<std::string>> texts = {{"--parameters",
                                                                    {"prm", "md"}},
                                                                   {"--columns", {"md"}},
                                                                   {"--scenes", {}},
                                                                   {"--version", {}},
                                                                   {"--help", {}},
                                                                   {"-h", {}}};

    /** The first clause of the comment at the head of a scene file. */
    std::string
    first_clause(const std::filesystem::path &scene)
    {
      std::ifstream file(scene);
      std::string   comment;
      for (std::string line; std::getline(file, line) && line.compare(0, 2, "# ") == 0;)
        comment += (comment.empty() ? "" : " ") + trim(line.substr(2));
      return comment.substr(
        0, std::min({comment.find(". "), comment.find(": "), comment.find("; ")}));
    }
  } // namespace

  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine                    command;
    std::string                    output;
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    for (auto word = words.begin(); word != words.end(); ++word)
      {
        std::string                name = *word;
        std::optional<std::string> value; // "--name=value"
        const auto                 equals = name.find('=');
        if (name.compare(0, 2, "--") == 0 && equals != std::string::npos)
          {
            value = name.substr(equals + 1);
            name.resize(equals);
          }
        const auto take_value = [&](const std::string &meaning) {
          if (!value && word + 1 != words.end())
            value = *++word;
          require(value && !value->empty(),
                  format("The option %s needs %s after it.",
                         name.c_str(),
                         meaning.c_str()));
          return *value;
        };

        const auto flag = flags.find(name);
        const auto text = texts.find(name);
        require(!value ||
                  (flag == flags.end() && (text == texts.end() || !text->second.empty())),
                "The option " + name + " takes no value.");
        if (flag != flags.end())
          command.*flag->second = true;
        else if (text != texts.end())
          {
            const std::vector<std::string> &formats = text->second;
            if (!value && word + 1 != words.end() &&
                std::find(formats.begin(), formats.end(), word[1]) != formats.end())
              value = *++word;
            command.text   = name;
            command.format = value.value_or(formats.empty() ? "" : formats.front());
          }
        else if (name == "--set")
          command.overrides.push_back(take_value("\"Section/Parameter=value\""));
        else if (name == "--output")
          output = take_value("a folder");
        else if (name.compare(0, 1, "-") == 0)
          {
            std::vector<std::string> known = {"--set", "--output"};
            for (const auto &[option, member] : flags)
              known.push_back(option);
            for (const auto &[option, formats] : texts)
              known.push_back(option);
            throw InputError(
              "Unknown option '" + name + "'" +
              suggestion(nearest_name(name, known), "; see 'strait --help'."));
          }
        else
          {
            require(command.scene.empty(),
                    "One scene at a time, but both '" + command.scene + "' and '" + name +
                      "' were given; put options that contain blanks in quotes.");
            command.scene = name;
          }
      }

    if (!output.empty())
      command.overrides.push_back("Output/Directory=" + output);
    require(command.scene.empty() || command.text.empty(),
            "'" + command.scene +
              "' is no scene to be run where something to read is asked for; leave it "
              "out, or see 'strait --help' for the formats.");
    require(!command.scene.empty() || !command.text.empty(),
            "No scene was given; try 'strait SCENE.prm' or 'strait --help'.");
    return command;
  }

  std::string
  list_of_scenes()
  {
    // Where strait is installed, the folder is beside the scripts; in the source tree it
    // is beside their folder.
    std::string folder = find_script("prm");
    if (folder.empty())
      folder = find_script("../prm");
    require(!folder.empty(), "The scenes that come with strait were not found.");
    std::vector<std::filesystem::path> scenes;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".prm")
        scenes.push_back(entry.path());
    std::sort(scenes.begin(), scenes.end());
    std::string text = "Scenes in " + folder + ":\n\n";
    for (const std::filesystem::path &scene : scenes)
      text += format("  %-28s", scene.filename().c_str()) + first_clause(scene) + "\n";
    return text;
  }

  std::string
  help_text()
  {
    return R"(strait: leak rate of rough elastic seals

  strait [options] SCENE.prm            (in parallel: mpirun -np P strait ...)

  --set "Section/Parameter=value"   override a parameter of the scene; repeatable
  --output DIR                      folder of the results, overrides Output/Directory
  --resume                          continue the run in the folder of the results from
                                    its last complete step, on any number of ranks
  --force                           overwrite the results of another scene, or a run that
                                    can be resumed
  --dry-run                         check the scene, print sizes, memory, warnings and
                                    active effects; compute nothing
  --parameters [prm|md]             print all parameters with defaults, units and
                                    meaning
  --columns [md]                    print all tables of results with the units and
                                    meaning of their columns
  --scenes                          list the scenes that come with strait
  --quiet                           nothing on the screen but errors
  --version
  --help

Exit status: 0 all steps done and converged; 1 some step did not converge (the
results so far are kept and marked); 2 bad scene, input file or usage; 3 stopped
after a step or solve by SIGTERM, SIGINT or SIGUSR1, --resume continues. To stop a
run under mpirun, send SIGUSR1 to mpirun: on the others it kills within a second.
)";
  }
} // namespace strait
