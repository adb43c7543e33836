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
   * The file of a run's state: a signature, the items in their order, each with its
   * kind and size, and at the end a checksum of all that, so that a file that was cut off
   * or changed is recognised before anything is taken from it.
   *
   * Rank 0 alone writes and reads; the rows of a field pass by it one after the other.
   * The file is in the byte order of the machine.
   */
  class CheckpointWriter : public StateArchive
  {
  public:
    /** Write to a file beside @p path. Errors wait for commit(). Collective. */
    CheckpointWriter(const std::string &path, MPI_Comm comm);

    /** Removes what was not committed. */
    ~CheckpointWriter() override;

    CheckpointWriter(const CheckpointWriter &)            = delete;
    CheckpointWriter &operator=(const CheckpointWriter &) = delete;

    bool
    is_reading() const override
    {
      return false;
    }

    using StateArchive::value;
    void value(double &number) override;
    void value(std::string &text) override;
    void value(std::vector<double> &numbers) override;

    /**
     * Put the file in the place of the one before, once it is safe on the disk: at any
     * moment one of the two is there, whole. Collective. Throws ComputationError if
     * anything could not be written; then the one before stays.
     */
    void commit();

  private:
    void rows(void *local, std::size_t point_size, const SlabLayout &layout) override;
    void put_item(char kind, const void *data, std::uint64_t size);
    void put(const void *data, std::size_t size);
    void flush();

    std::string   path;
    MPI_Comm      comm;
    bool          on_root;
    int           file     = -1; // descriptor
    int           error    = 0;  // errno of the first failure
    std::uint64_t checksum = 0;

    std::vector<unsigned char> buffer;
  };

  /** Gives back what a CheckpointWriter put into its file. */
  class CheckpointReader : public StateArchive
  {
  public:
    /**
     * Open @p path and check it from end to end. Collective. Throws InputError on all
     * ranks if there is no such file, or none that a CheckpointWriter completed.
     */
    CheckpointReader(const std::string &path, MPI_Comm comm);
    ~CheckpointReader() override;

    CheckpointReader(const CheckpointReader &)            = delete;
    CheckpointReader &operator=(const CheckpointReader &) = delete;

    bool
    is_reading() const override
    {
      return true;
    }

    using StateArchive::value;
    void value(double &number) override;
    void value(std::string &text) override;
    void value(std::vector<double> &numbers) override;

  private:
    void rows(void *local, std::size_t point_size, const SlabLayout &layout) override;
    std::string       take_item(char kind);
    std::uint64_t     take_head(char kind);
    void              take(void *data, std::size_t size);
    void              check_whole_file();
    [[noreturn]] void refuse() const;

    std::string path;
    MPI_Comm    comm;
    bool        on_root;
    std::FILE  *file      = nullptr;
    std::size_t remaining = 0; // bytes of items
  };
} // namespace strait

#endif
