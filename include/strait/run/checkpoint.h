// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_checkpoint_h
#define strait_run_checkpoint_h

#include <strait/spectral/state_archive.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace strait
{
  /**
   * The file of a run's state: a signature, the items in their order, each after its
   * size in bytes, and at the end a checksum of all that, so that a file that was cut off
   * or changed is recognised before anything is taken from it.
   *
   * Rank 0 alone writes and reads; the rows of a field pass by it one after the other.
   * The file is in the byte order of the machine.
   */
  class Checkpoint : public StateArchive
  {
  public:
    /** What is to be done with the file. */
    enum class Access
    {
      write,
      read
    };

    /**
     * Write to a file beside @p path, where errors wait for commit(), or open @p path and
     * check it from end to end. Collective. Throws InputError on all ranks if there is
     * nothing to read, or no file that was committed.
     */
    Checkpoint(const std::string &path, MPI_Comm comm, Access access);

    /** Removes what was not committed. */
    ~Checkpoint() override;

    Checkpoint(const Checkpoint &)            = delete;
    Checkpoint &operator=(const Checkpoint &) = delete;

    bool
    is_reading() const override
    {
      return access == Access::read;
    }

    using StateArchive::value;
    void value(double &number) override;
    void value(std::string &text) override;
    void value(std::vector<double> &numbers) override;

    /**
     * Put the file that was written in the place of the one before, once it is safe on
     * the disk: at any moment one of the two is there, whole. Collective. Throws
     * ComputationError if anything could not be written; then the one before stays.
     */
    void commit();

  private:
    void rows(void *local, std::size_t point_size, const SlabLayout &layout) override;
    std::string       item(std::string bytes);
    std::size_t       size_of_item(std::size_t size);
    bool              pass(void *data, std::size_t size);
    void              keep_error_unless(bool succeeds);
    void              check_whole_file();
    [[noreturn]] void refuse() const;

    const std::string path;
    const MPI_Comm    comm;
    const Access      access;

    // Of rank 0.
    std::FILE    *file      = nullptr;
    std::size_t   remaining = 0; // bytes of items to be read
    int           error     = 0; // errno of the first failure in writing
    std::uint32_t checksum  = 0; // of what was written
  };
} // namespace strait

#endif
