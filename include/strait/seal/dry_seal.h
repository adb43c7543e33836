// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_seal_dry_seal_h
#define strait_seal_dry_seal_h

#include <strait/contact/contact_model.h>
#include <strait/seal/seal_model.h>

#include <memory>
#include <utility>

namespace strait
{
  /** The gap is given, and nothing changes it. */
  class GivenGap : public SealModel
  {
  public:
    /** @p gap is below zero where closed [length]. Collective. */
    explicit GivenGap(SlabField gap);

    SealState solve(const Control &control, const SealState *from, Aim aim) override;

    bool
    depends_on_path() const override
    {
      return false;
    }

  private:
    SlabField gap;
    double    mean_gap;
  };

  /** A contact, with or without adhesion, on whose walls no fluid presses. */
  class DrySeal : public SealModel
  {
  public:
    explicit DrySeal(std::unique_ptr<ContactModel> contact_)
      : contact(std::move(contact_))
    {
    }

    SealState solve(const Control &control, const SealState *from, Aim aim) override;

    bool
    depends_on_path() const override
    {
      return contact->depends_on_path();
    }

  private:
    std::unique_ptr<ContactModel> contact;
  };
} // namespace strait

#endif
