// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/text.h>
#include <strait/base/timers.h>

#include <algorithm>
#include <functional>

namespace strait
{
  std::shared_ptr<void>
  Timers::scope(const std::string &name)
  {
    std::list<Node> &parts = innermost->parts;
    auto part = std::find_if(parts.begin(), parts.end(), [&name](const Node &node) {
      return node.name == name;
    });
    if (part == parts.end())
      part = parts.insert(part, {name, innermost});
    innermost = &*part;
    return std::shared_ptr<Node>(innermost, [this, begin = Clock::now()](Node *timed) {
      timed->seconds += seconds_since(begin);
      innermost = timed->whole;
    });
  }

  std::vector<Timers::Part>
  Timers::table() const
  {
    std::vector<Part> rows;

    const std::function<void(const Node &, const std::string &, int, double)> append =
      [&](const Node        &node,
          const std::string &path_of_whole,
          const int          depth,
          const double       seconds) {
        const std::string path = path_of_whole + node.name;
        rows.push_back({path, depth, seconds});
        if (node.parts.empty())
          return;
        const std::string path_here = depth == 0 ? "" : path + "/";
        double            rest      = seconds;
        for (const Node &part : node.parts)
          {
            append(part, path_here, depth + 1, part.seconds);
            rest -= part.seconds;
          }
        // While a part is still being timed, it may have less time than its own parts.
        rows.push_back({path_here + "other", depth + 1, std::max(rest, 0.)});
      };
    append(total_time, "", 0, seconds_since(start));
    return rows;
  }

  std::string
  Timers::summary() const
  {
    std::string text;
    for (const Part &part : table())
      {
        const std::string indent(2 * static_cast<std::size_t>(part.depth), ' ');
        const std::string name = part.path.substr(part.path.rfind('/') + 1);
        text += format("%-32s%10.2f s\n", (indent + name).c_str(), part.seconds);
      }
    return text;
  }
} // namespace strait
