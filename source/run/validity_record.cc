// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/validity.h>

#include <nlohmann/json.hpp>

#include <utility>

namespace strait
{
  std::string
  validity_record(const Step &step)
  {
    using Json  = nlohmann::ordered_json;
    Json checks = Json::array();
    for (const ValidityCheck &check : step.checks)
      {
        Json entry = {{"word", check.word},
                      {"number", check.number},
                      {check.is_least ? "least" : "most", check.limit},
                      {"holds", check.holds()}};
        if (!check.holds())
          entry["advice"] = check.advice;
        checks.push_back(std::move(entry));
      }
    const Json record = {{"step", step.number},
                         {"validity", step.validity()},
                         {"checks", checks}};
    return record.dump();
  }
} // namespace strait
