// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/surface/make_surface.h>
#include <strait/surface/readers/height_map.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace strait::test
{
  /** Return all heights of a surface on nx × ny points, row by row, on every rank. */
  inline std::vector<double>
  whole_surface(const SurfaceParameters &parameters, const int nx, const int ny)
  {
    const SlabLayoutPtr layout =
      make_layout({nx, ny, parameters.size[0], parameters.size[1]}, MPI_COMM_WORLD);
    std::vector<int> rows(ny);
    for (int row = 0; row < ny; ++row)
      rows[row] = row;
    return fetch_rows(make_surface(parameters, layout), rows);
  }

  /** Return the message of the InputError that @p action throws; if it throws none, the
   *  test fails. */
  template <class Action>
  std::string
  input_error(const Action &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    ADD_FAILURE() << "no InputError was thrown";
    return {};
  }

  inline testing::AssertionResult
  mentions(const std::string &message, const std::string &part)
  {
    if (message.find(part) != std::string::npos)
      return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "\"" << message << "\" lacks \"" << part << "\"";
  }

  /** A file that rank 0 writes; all ranks know its path. It goes with this object. */
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &content)
    {
      static int n_files = 0;
      const auto name    = "strait-test-" + std::to_string(getpid()) + "-" +
                        std::to_string(n_files++) + ".map";
      path = broadcast(MPI_COMM_WORLD,
                       (std::filesystem::temp_directory_path() / name).string());
      run_on_root(MPI_COMM_WORLD,
                  [&]() { std::ofstream(path, std::ios::binary) << content; });
    }

    ~TemporaryFile()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
    }

    TemporaryFile(const TemporaryFile &)            = delete;
    TemporaryFile &operator=(const TemporaryFile &) = delete;

    std::string path;
  };

  /** Return the map that is read from a file with this @p content. */
  inline HeightMap
  read_map(const std::string &content)
  {
    return read_height_map(TemporaryFile(content).path);
  }

  /** Return the message with which a file with this @p content is refused. */
  inline std::string
  complaint_of_map(const std::string &content)
  {
    const TemporaryFile file(content);
    return input_error([&file]() { read_height_map(file.path); });
  }

  /** Return the content of a .npy file of format @p version: a header with @p dictionary,
   *  then @p data. */
  inline std::string
  npy(const std::string &dictionary, const std::string &data, const int version = 1)
  {
    const std::string header = dictionary + std::string(20, ' ') + "\n";
    std::string       file   = "\x93NUMPY";
    file += static_cast<char>(version);
    file += '\0';
    for (int i = 0; i < (version == 1 ? 2 : 4); ++i)
      file += static_cast<char>(header.size() >> (8 * i) & 0xff);
    return file + header + data;
  }

  inline std::string
  dictionary(const std::string &type,
             const std::string &shape,
             const std::string &fortran = "False")
  {
    return "{'descr': '" + type + "', 'fortran_order': " + fortran +
           ", 'shape': " + shape + ", }";
  }

  /** Return the bytes of @p numbers on this machine, which must be little-endian. */
  template <class Number>
  std::string
  bytes(const std::vector<Number> &numbers)
  {
    std::string result(numbers.size() * sizeof(Number), '\0');
    std::memcpy(result.data(), numbers.data(), result.size());
    return result;
  }
} // namespace strait::test
