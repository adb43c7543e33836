// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_spectral_state_archive_h
#define strait_spectral_state_archive_h

#include <strait/spectral/slab_field.h>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace strait
{
  /**
   * Where a run's state is put to continue it later, or taken from.
   *
   * A class with such a state has one function `transfer(StateArchive &)` that names
   * its members one after the other, for both directions. All functions are collective.
   * Scalars, texts and lists are those of rank 0 when they are put and the same on all
   * ranks when they are taken. Fields do not depend on the number of ranks.
   */
  class StateArchive
  {
  public:
    virtual ~StateArchive() = default;

    /** Whether members are taken from the archive rather than put there. */
    virtual bool is_reading() const = 0;

    /** A number. */
    virtual void value(double &number) = 0;

    /** A text, of any length. */
    virtual void value(std::string &text) = 0;

    /** A list of numbers, of any length. */
    virtual void value(std::vector<double> &numbers) = 0;

    /** A list of texts, of any length. */
    void value(std::vector<std::string> &texts);

    /** A whole number that a double holds exactly, or a yes or no. */
    template <typename Number>
    std::enable_if_t<std::is_integral_v<Number>>
    value(Number &number)
    {
      auto exact = static_cast<double>(number);
      value(exact);
      number = static_cast<Number>(exact);
    }

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

  protected:
    /** All points of this rank, each of @p point_size bytes. */
    virtual void rows(void *local, std::size_t point_size, const SlabLayout &layout) = 0;

  private:
    template <typename Number>
    void all_values(Number *local, const SlabLayout &layout);
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

#endif
