// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/timers.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace strait
{
  Timers::Scope::Scope(Timers &timers, const std::size_t part, const std::size_t parent)
    : timers(timers)
    , part(part)
    , parent(parent)
  {
  }

  Timers::Scope::~Scope()
  {
    timers.nodes[part].seconds += seconds_since(start);
    timers.innermost = parent;
  }

  Timers::Timers()
    : nodes(1, Node{"total", 0, {}})
  {
  }

  Timers::Scope
  Timers::scope(const std::string &name)
  {
    const std::size_t parent = innermost;
    for (const std::size_t child : nodes[parent].children)
      if (nodes[child].name == name)
        {
          innermost = child;
          return {*this, child, parent};
        }
    innermost = nodes.size();
    nodes.push_back(Node{name, parent, {}});
    nodes[parent].children.push_back(innermost);
    return {*this, innermost, parent};
  }

  double
  Timers::total() const
  {
    return seconds_since(start);
  }

  std::vector<Timers::Part>
  Timers::table() const
  {
    std::vector<Part> rows;
    append(rows, 0, 0, total());
    return rows;
  }

  std::string
  Timers::summary() const
  {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2);
    for (const Part &part : table())
      {
        const std::string indent(2 * static_cast<std::size_t>(part.depth), ' ');
        const std::string name = part.path.substr(part.path.rfind('/') + 1);
        out << std::left << std::setw(32) << indent + name << std::right << std::setw(10)
            << part.seconds << " s\n";
      }
    return out.str();
  }

  std::string
  Timers::path(const std::size_t node) const
  {
    if (node == 0)
      return nodes[0].name;
    const std::size_t parent = nodes[node].parent;
    return (parent == 0 ? "" : path(parent) + "/") + nodes[node].name;
  }

  void
  Timers::append(std::vector<Part> &rows,
                 const std::size_t  node,
                 const int          depth,
                 const double       seconds) const
  {
    rows.push_back({path(node), depth, seconds});
    if (nodes[node].children.empty())
      return;
    double rest = seconds;
    for (const std::size_t child : nodes[node].children)
      {
        append(rows, child, depth + 1, nodes[child].seconds);
        rest -= nodes[child].seconds;
      }
    const std::string prefix = node == 0 ? "" : path(node) + "/";
    // A part that is still being timed has less on its clock than its children.
    rows.push_back({prefix + "other", depth + 1, std::max(rest, 0.)});
  }
} // namespace strait
