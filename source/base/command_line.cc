// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/command_line.h>
#include <strait/base/exceptions.h>
#include <strait/base/text.h>

namespace strait
{
  namespace
  {
    const std::vector<std::string> options = {"--set",
                                              "--output",
                                              "--resume",
                                              "--dry-run",
                                              "--parameters",
                                              "--columns",
                                              "--quiet",
                                              "--version",
                                              "--help"};

    /** The arguments one after the other, "--name=value" taken apart. */
    class Arguments
    {
    public:
      Arguments(const int argc, const char *const *argv)
        : words(argv + (argc > 0 ? 1 : 0), argv + argc)
      {
      }

      bool
      next()
      {
        if (position == words.size())
          return false;
        name = words[position++];
        inline_value.clear();
        has_inline_value  = false;
        const auto equals = name.find('=');
        if (name.compare(0, 2, "--") == 0 && equals != std::string::npos)
          {
            inline_value     = name.substr(equals + 1);
            has_inline_value = true;
            name.resize(equals);
          }
        return true;
      }

      /** The value of this option; @p meaning says what is missing if it is. */
      std::string
      value(const std::string &meaning)
      {
        if (has_inline_value)
          {
            has_inline_value = false;
            return inline_value;
          }
        if (position == words.size())
          throw InputError("The option " + name + " needs " + meaning + " after it.");
        return words[position++];
      }

      /** The word after this option if it is one of @p values. */
      std::string
      optional_value(const std::vector<std::string> &values, const std::string &standard)
      {
        if (has_inline_value)
          return value("");
        for (const std::string &candidate : values)
          if (position < words.size() && words[position] == candidate)
            return words[position++];
        return standard;
      }

      void
      check_no_value() const
      {
        if (has_inline_value)
          throw InputError("The option " + name + " takes no value.");
      }

      std::string name;

    private:
      std::vector<std::string> words;
      std::size_t              position = 0;
      std::string              inline_value;
      bool                     has_inline_value = false;
    };

    void
    take_scene(CommandLine &command, const std::string &word)
    {
      if (!word.empty() && word[0] == '-')
        throw InputError(
          "Unknown option '" + word + "'" +
          suggestion(nearest_name(word, options), "; see 'strait --help'."));
      if (!command.scene.empty())
        throw InputError("One scene at a time, but both '" + command.scene + "' and '" +
                         word +
                         "' were given; put options that contain blanks in "
                         "quotes.");
      command.scene = word;
    }

    void
    take_flag(CommandLine &command, const Arguments &arguments)
    {
      if (arguments.name == "--dry-run")
        command.dry_run = true;
      else if (arguments.name == "--resume")
        command.resume = true;
      else if (arguments.name == "--quiet")
        command.quiet = true;
      else if (arguments.name == "--version")
        command.version = true;
      else if (arguments.name == "--help" || arguments.name == "-h")
        command.help = true;
      else
        {
          take_scene(command, arguments.name);
          return;
        }
      arguments.check_no_value();
    }
  } // namespace

  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine command;
    std::string output;
    Arguments   arguments(argc, argv);
    while (arguments.next())
      if (arguments.name == "--set")
        command.overrides.push_back(arguments.value("\"Section/Parameter=value\""));
      else if (arguments.name == "--output")
        {
          output = arguments.value("a folder");
          if (output.empty())
            throw InputError("The option --output needs a folder after it.");
        }
      else if (arguments.name == "--parameters")
        command.parameters_format = arguments.optional_value({"prm", "md"}, "prm");
      else if (arguments.name == "--columns")
        command.columns_format = arguments.optional_value({"md"}, "md");
      else
        take_flag(command, arguments);

    if (!output.empty())
      command.overrides.push_back("Output/Directory=" + output);
    const bool needs_scene = !command.help && !command.version &&
                             command.parameters_format.empty() &&
                             command.columns_format.empty();
    if (needs_scene && command.scene.empty())
      throw InputError("No scene was given; try 'strait SCENE.prm' or 'strait --help'.");
    return command;
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
  --dry-run                         check the scene, print sizes, memory, warnings and
                                    active effects; compute nothing
  --parameters [prm|md]             print all parameters with defaults, units and
                                    meaning
  --columns [md]                    print all tables of results with the units and
                                    meaning of their columns
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
