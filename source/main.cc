// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/build_info.h>
#include <strait/base/collective.h>
#include <strait/base/command_line.h>
#include <strait/base/exceptions.h>
#include <strait/base/log.h>
#include <strait/base/signals.h>
#include <strait/run/output_directory.h>
#include <strait/run/result_tables.h>
#include <strait/run/run_state.h>
#include <strait/run/simulation.h>
#include <strait/surface/read_scene.h>

#include <deal.II/base/mpi.h>

#include <malloc.h>

#include <filesystem>
#include <iostream>

namespace
{
  /** Return the memory of freed fields to the system. Libraries for fast networks tell
   *  the allocator to keep all of it, so that the next stage would need more on top. */
  void
  give_freed_memory_back()
  {
    constexpr int megabyte = 1 << 20;
    mallopt(M_MMAP_MAX, 1 << 16);
    mallopt(M_MMAP_THRESHOLD, megabyte);
    // Matrices consist of pieces below that size. Without some slack at the end of the
    // heap their pages would be returned to the system and requested again.
    mallopt(M_TRIM_THRESHOLD, 64 * megabyte);
    mallopt(M_TOP_PAD, 16 * megabyte);
  }

  int
  run(const int argc, char **argv)
  {
    using namespace strait;
    const CommandLine command = parse_command_line(argc, argv);
    if (!command.text.empty())
      {
        if (rank_in(MPI_COMM_WORLD) > 0)
          return 0;
        if (command.text == "--version")
          std::cout << "strait " << version << std::endl;
        else if (command.text == "--scenes")
          std::cout << list_of_scenes();
        else if (command.text == "--columns")
          print_columns(std::cout, command.format);
        else if (command.text == "--parameters")
          print_parameters(std::cout, command.format);
        else
          std::cout << help_text();
        return 0;
      }
    const Scene scene = read_scene(command.scene, command.overrides);
    if (scene.seal.enabled)
      run_on_root(MPI_COMM_WORLD, [&]() { check_seal_profile(scene); });
    Log log(MPI_COMM_WORLD, command.quiet);
    catch_signals();
    const auto check_folder = [&]() {
      if (!command.force && !command.resume)
        refuse_to_replace_results(scene, MPI_COMM_WORLD);
    };
    if (command.dry_run)
      {
        describe(scene, log);
        try
          {
            check_folder();
          }
        catch (const InputError &error)
          {
            log.warn(std::string("a run would end here: ") + error.what());
          }
        return 0;
      }
    check_folder();
    if (!run_all_realisations(scene, log, command.resume))
      throw ComputationError(
        "Some steps, or states that a critical load or blow-out pressure rests on, did "
        "not reach what was asked; the column status of the table in '" +
        scene.output.directory + "' and its log tell which and why.");
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  // PETSc, which deal.II starts together with MPI, aborts if there is no current folder.
  if (std::error_code none; std::filesystem::current_path(none).empty())
    {
      std::cerr << "strait: The current folder is gone; change to another." << std::endl;
      return 2;
    }
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  give_freed_memory_back();
  return strait::with_clear_exit(MPI_COMM_WORLD, [&]() { return run(argc, argv); });
}
