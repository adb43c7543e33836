// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/spectral/slab_field.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /**
   * A checkpoint file, to which the state of a run is written, or from which it is read
   * to continue the run.
   *
   * A class with such a state has one function `transfer(StateArchive &, ...)`, for both
   * directions, that names its members one after the other. All functions are collective.
   * Scalars, texts and lists are those of rank 0 when they are written, and the same on
   * all ranks when they are read. Fields do not depend on the number of ranks.
   *
   * The file has a signature, the items in their order, each after its size in bytes, and
   * a checksum of all that at the end, so that a truncated or changed file is recognised
   * before anything is taken from it. Only rank 0 writes and reads; the rows of a field
   * pass through it one after the other. The file has the byte order of the machine.
   */
  class StateArchive
  {
  public:
    /** What is to be done with the file. */
    enum class Access
    {
      write,
      read
    };

    /** Begin a file beside @p path, whose errors commit() reports, or open @p path and
     *  check it from end to end. Collective. Throws InputError on all ranks if there is
     *  no file to read, or if it is not a whole checkpoint of this version of strait. */
    StateArchive(const std::string &path, MPI_Comm comm, Access access);

    /** Removes a file that was not committed. */
    ~StateArchive();

    StateArchive(const StateArchive &)            = delete;
    StateArchive &operator=(const StateArchive &) = delete;

    /** Whether members are read from the archive rather than written to it. */
    bool
    is_reading() const
    {
      return access == Access::read;
    }

    /** Transfer a number, a bool, or a record of such, as it is in memory. */
    template <typename Record>
    std::enable_if_t<std::is_trivially_copyable_v<Record>>
    value(Record &record)
    {
      clear_padding(record);
      const std::string bytes =
        item({reinterpret_cast<const char *>(&record), sizeof record});
      if (bytes.size() != sizeof record) // on all ranks
        refuse();
      std::memcpy(&record, bytes.data(), sizeof record);
    }

    /** Transfer a list of such values, of any length. */
    template <typename Record>
    std::enable_if_t<std::is_trivially_copyable_v<Record>>
    value(std::vector<Record> &records)
    {
      for (Record &record : records)
        clear_padding(record);
      const auto       *begin = reinterpret_cast<const char *>(records.data());
      const std::string bytes = item({begin, records.size() * sizeof(Record)});
      if (bytes.size() % sizeof(Record) != 0)
        refuse();
      records.resize(bytes.size() / sizeof(Record));
      if (!records.empty()) // data() may be null otherwise
        std::memcpy(records.data(), bytes.data(), records.size() * sizeof(Record));
    }

    /** Transfer a text of any length. */
    void value(std::string &text);

    /** Transfer a list of texts, of any length. */
    void value(std::vector<std::string> &texts);

    /** Transfer several of all these, one after the other. */
    template <typename... Values>
    void
    values(Values &...several)
    {
      (value(several), ...);
    }

    /** Transfer a field on the grid of @p layout, with its windows. It may be empty(). */
    void field(SlabField &values, const SlabLayoutPtr &layout);

    /** Transfer the values, double or float, of a field with this @p layout, windows
     *  included; or nothing, if there are none on any rank. */
    template <typename Number>
    void field(std::vector<Number> &values, const SlabLayout &layout);

    /**
     * Replace the previous file by the one that was written, once this is safe on the
     * disk: at any moment one of the two is there, whole. Collective. Throws
     * ComputationError if anything could not be written; then the previous file stays.
     */
    void commit();

  private:
    /** Clear the padding between the members of a record: it is written as well, and must
     *  be the same in every run. */
    template <typename Record>
    static void
    clear_padding([[maybe_unused]] Record &record)
    {
#if defined(__GNUC__) && !defined(__clang__) // which lacks this builtin
      __builtin_clear_padding(&record);
#endif
    }

    template <typename Number>
    void              all_values(Number *local, const SlabLayout &layout);
    void              rows(void *local, std::size_t point_size, const SlabLayout &layout);
    std::string       item(std::string bytes);
    std::size_t       size_of_item(std::size_t size);
    bool              pass(void *data, std::size_t size);
    void              keep_error_unless(bool succeeds);
    void              check_whole_file();
    [[noreturn]] void refuse() const;

    const std::string path;
    const MPI_Comm    comm;
    const Access      access;

    // Used on rank 0 only.
    std::FILE    *file      = nullptr;
    std::size_t   remaining = 0; // bytes of items to be read
    int           error     = 0; // errno of the first failure in writing
    std::uint32_t checksum  = 0; // of what was written
  };

  /** Transfer a list of any length; @p transfer_item transfers one of its items.
   *  Collective. */
  template <typename Item, typename Transfer>
  void
  transfer_all(StateArchive      &archive,
               std::vector<Item> &items,
               const Transfer    &transfer_item)
  {
    auto n_items = static_cast<long>(items.size());
    archive.value(n_items);
    items.resize(n_items);
    for (Item &item : items)
      transfer_item(item);
  }

  /** Transfer whether there is a @p value, and return it. Reading creates the value, to
   *  be read next, or removes it. Collective. */
  template <typename Value>
  bool
  transfer_presence(StateArchive &archive, std::optional<Value> &value)
  {
    bool exists = value.has_value();
    archive.value(exists);
    if (exists != value.has_value())
      value = exists ? std::make_optional<Value>() : std::nullopt;
    return exists;
  }
} // namespace strait
