// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/choices.h>
#include <strait/base/exceptions.h>
#include <strait/base/realisation_parameters.h>
#include <strait/base/text.h>

#include <deal.II/base/parameter_handler.h>

#include <set>

namespace strait
{
  namespace
  {
    const Choices<Orientation> orientation_names = {{Orientation::as_is, "as is"},
                                                    {Orientation::inverted, "inverted"},
                                                    {Orientation::rotated, "rotated"},
                                                    {Orientation::inverted_and_rotated,
                                                     "inverted and rotated"}};
  } // namespace

  std::string
  name_of(const Orientation orientation)
  {
    return orientation_names.name(orientation);
  }

  void
  RealisationParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Realisations");
    prm.declare_entry(
      "Seeds",
      "",
      List(Integer(0)),
      "Run the scene for each of these seeds instead of Surface/Seed, each "
      "with its own folder of results; compare them in ensemble.csv.");
    prm.declare_entry("Orientations",
                      orientation_names.name(Orientation::as_is),
                      List(Selection(orientation_names.pattern()), 1),
                      "Run each seed in these orientations, which replace Surface/Invert "
                      "and Surface/Rotate.");
    prm.leave_subsection();
  }

  void
  RealisationParameters::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Realisations");
    seeds.clear();
    for (const std::string &value : split(prm.get("Seeds"), ','))
      if (!value.empty())
        seeds.push_back(std::stoull(value));
    orientations.clear();
    for (const std::string &value : split(prm.get("Orientations"), ','))
      orientations.push_back(orientation_names.value(value));
    prm.leave_subsection();
  }

  void
  RealisationParameters::check() const
  {
    const std::set<unsigned long long> different_seeds(seeds.begin(), seeds.end());
    const std::set<Orientation> different(orientations.begin(), orientations.end());
    if (different_seeds.size() != seeds.size() || different.size() != orientations.size())
      throw InputError(
        "Realisations lists a seed or an orientation twice; the copies would "
        "falsify the scatter, remove them.");
  }
} // namespace strait
