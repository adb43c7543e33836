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
   * The file where a run's state is put to continue it later, or taken from.
   *
   * A class with such a state has one function `transfer(StateArchive &)` that names
   * its members one after the other, for both directions. All functions are collective.
   * Scalars, texts and lists are those of rank 0 when they are put and the same on all
   * ranks when they are taken. Fields do not depend on the number of ranks.
   *
   * In the file there are a signature, the items in their order, each after its size in
   * bytes, and at the end a checksum of all that, so that a file that was cut off or
   * changed is recognised before anything is taken from it. Rank 0 alone writes and
   * reads; the rows of a field pass by it one after the other. The file is in the byte
   * order of the machine.
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

    /**
     * Write to a file beside @p path, where errors wait for commit(), or open @p path and
     * check it from end to end. Collective. Throws InputError on all ranks if there is
     * nothing to read, or no file that was committed.
     */
    StateArchive(const std::string &path, MPI_Comm comm, Access access);

    /** Removes what was not committed. */
    ~StateArchive();

    StateArchive(const StateArchive &)            = delete;
    StateArchive &operator=(const StateArchive &) = delete;

    /** Whether members are taken from the archive rather than put there. */
    bool
    is_reading() const
    {
      return access == Access::read;
    }

    /** A number, a yes or no, or a record of such as it is in memory. */
    template <typename Record>
    std::enable_if_t<std::is_trivially_copyable_v<Record>>
    value(Record &record)
    {
      clear_gaps(record);
      const std::string bytes =
        item({reinterpret_cast<const char *>(&record), sizeof record});
      if (bytes.size() != sizeof record) // on all ranks
        refuse();
      std::memcpy(&record, bytes.data(), sizeof record);
    }

    /** A list of them, of any length. */
    template <typename Record>
    std::enable_if_t<std::is_trivially_copyable_v<Record>>
    value(std::vector<Record> &records)
    {
      for (Record &record : records)
        clear_gaps(record);
      const auto       *begin = reinterpret_cast<const char *>(records.data());
      const std::string bytes = item({begin, records.size() * sizeof(Record)});
      if (bytes.size() % sizeof(Record) != 0)
        refuse();
      records.resize(bytes.size() / sizeof(Record));
      if (!records.empty()) // whose data may be nowhere
        std::memcpy(records.data(), bytes.data(), records.size() * sizeof(Record));
    }

    /** A text, of any length. */
    void value(std::string &text);

    /** A list of texts, of any length. */
    void value(std::vector<std::string> &texts);

    /** Several of all these, one after the other. */
    template <typename... Values>
    void
    values(Values &...several)
    {
      (value(several), ...);
    }

    /** A field on the grid of @p layout, which may be empty(), with its windows. */
    void field(SlabField &values, const SlabLayoutPtr &layout);

    /** The values, double or float, of a field like @p layout, windows included, or none
     * on any rank. */
    template <typename Number>
    void field(std::vector<Number> &values, const SlabLayout &layout);

    /**
     * Put the file that was written in the place of the one before, once it is safe on
     * the disk: at any moment one of the two is there, whole. Collective. Throws
     * ComputationError if anything could not be written; then the one before stays.
     */
    void commit();

  private:
    /** What stands between the members of a record is put as well, and shall be the same
     *  in every run. */
    template <typename Record>
    static void
    clear_gaps([[maybe_unused]] Record &record)
    {
#if defined(__GNUC__) && !defined(__clang__) // which knows no such thing
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

    // Of rank 0.
    std::FILE    *file      = nullptr;
    std::size_t   remaining = 0; // bytes of items to be read
    int           error     = 0; // errno of the first failure in writing
    std::uint32_t checksum  = 0; // of what was written
  };

  /** A list of any length; @p transfer_item puts or takes each of its items. Collective.
   */
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

  /** Whether there is a value, which is made where it is to be taken. Collective. */
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
