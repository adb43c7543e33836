// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_run_checkpoint_reader_h
#define strait_run_checkpoint_reader_h

#include <strait/spectral/state_archive.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace strait
{
  /** See CheckpointWriter. */
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
