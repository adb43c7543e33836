// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/surface/read_scene.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "temporary_folder.h"

namespace strait::test
{
  /** A scene file that exists on all ranks as long as this object does. */
  class SceneFile
  {
  public:
    explicit SceneFile(const std::string &text)
      : folder(temporary.path())
      , path(folder + "/a.prm")
    {
      run_on_root(MPI_COMM_WORLD, [&]() { std::ofstream(path) << text; });
    }

  private:
    const TemporaryFolder temporary;

  public:
    const std::string folder, path;
  };

  inline Scene
  scene_of(const std::string &text, const Overrides &overrides = {})
  {
    const SceneFile file(text);
    return read_scene(file.path, overrides);
  }

  /** Return @p all, followed by @p more. */
  inline Overrides
  operator+(Overrides all, const Overrides &more)
  {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /** Return the message with which a scene is refused, without the folder of its file;
   *  "none" if the scene is accepted. */
  inline std::string
  error_of(const std::string &text, const Overrides &overrides = {})
  {
    const SceneFile file(text);
    try
      {
        read_scene(file.path, overrides);
      }
    catch (const InputError &error)
      {
        std::string message = error.what();
        if (message.compare(0, file.folder.size(), file.folder) == 0)
          message.erase(0, file.folder.size() + 1);
        return message;
      }
    return "none";
  }

  inline void
  expect_in(const std::string &part, const std::string &text)
  {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' not in: " << text;
  }
} // namespace strait::test
