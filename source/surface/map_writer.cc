// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/base/collective.h>
#include <strait/base/exceptions.h>
#include <strait/surface/map_writer.h>

#include <netcdf.h>

namespace strait
{
  namespace
  {
    /** A NetCDF file that is being written. */
    class Writer
    {
    public:
      explicit Writer(const std::string &path_)
        : path(path_)
      {
        check(nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &file));
      }

      ~Writer()
      {
        if (file >= 0)
          nc_close(file);
      }

      Writer(const Writer &)            = delete;
      Writer &operator=(const Writer &) = delete;

      void
      check(const int status) const
      {
        if (status != NC_NOERR)
          throw ComputationError("The file '" + path + "' could not be written (" +
                                 nc_strerror(status) + ").");
      }

      int
      define_side(const char *name, const int n, const double length, int &dimension)
      {
        int       variable = -1;
        const int periodic = 1;
        check(nc_def_dim(file, name, static_cast<std::size_t>(n), &dimension));
        check(nc_def_var(file, name, NC_DOUBLE, 1, &dimension, &variable));
        check(nc_put_att_double(file, variable, "length", NC_DOUBLE, 1, &length));
        check(nc_put_att_int(file, variable, "periodic", NC_INT, 1, &periodic));
        return variable;
      }

      void
      state_unit(const int variable, const std::string &unit)
      {
        if (!unit.empty())
          check(nc_put_att_text(file, variable, "unit", unit.size(), unit.data()));
      }

      void
      write_coordinates(const int variable, const int n, const double spacing)
      {
        std::vector<double> values;
        for (int i = 0; i < n; ++i)
          values.push_back(i * spacing);
        check(nc_put_var_double(file, variable, values.data()));
      }

      void
      close()
      {
        const int status = nc_close(file);
        file             = -1;
        check(status);
      }

      int file = -1;

    private:
      std::string path;
    };
  } // namespace

  void
  write_netcdf_map(const std::string &path,
                   const SlabField   &heights,
                   const std::string &unit)
  {
    const PeriodicGrid       &grid  = heights.grid();
    const std::vector<double> whole = gather_on_root(heights);
    run_on_root(heights.layout().communicator(), [&]() {
      Writer    writer(path);
      int       dimensions[2] = {-1, -1}, variable = -1;
      const int x = writer.define_side("x", grid.nx, grid.lx, dimensions[0]);
      const int y = writer.define_side("y", grid.ny, grid.ly, dimensions[1]);
      // The last variable: only that may exceed what this format allows of others.
      writer.check(
        nc_def_var(writer.file, "heights", NC_DOUBLE, 2, dimensions, &variable));
      for (const int stated : {x, y, variable})
        writer.state_unit(stated, unit);
      writer.check(nc_enddef(writer.file));
      writer.write_coordinates(x, grid.nx, grid.dx());
      writer.write_coordinates(y, grid.ny, grid.dy());
      std::vector<double> column(static_cast<std::size_t>(grid.ny));
      for (int ix = 0; ix < grid.nx; ++ix)
        {
          for (int iy = 0; iy < grid.ny; ++iy)
            column[iy] = whole[static_cast<std::size_t>(iy) * grid.nx + ix];
          const std::size_t start[2] = {static_cast<std::size_t>(ix), 0};
          const std::size_t count[2] = {1, column.size()};
          writer.check(
            nc_put_vara_double(writer.file, variable, start, count, column.data()));
        }
      writer.close();
    });
  }
} // namespace strait
