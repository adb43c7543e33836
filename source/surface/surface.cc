// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/analytic_surfaces.h>
#include <strait/surface/expression_surface.h>
#include <strait/surface/file_surface.h>
#include <strait/surface/self_affine_surface.h>
#include <strait/surface/surface.h>
#include <strait/surface/transformed_surfaces.h>

#include <stdexcept>
#include <utility>

namespace strait
{
  namespace
  {
    /** One map, or the two of two rough bodies. */
    std::unique_ptr<const Surface>
    make_measured(const SurfaceParameters &parameters, MPI_Comm communicator)
    {
      const auto read = [&](const std::string &file) {
        return std::make_unique<FileSurface>(parameters, file, communicator);
      };
      if (parameters.map.second_file.empty())
        return read(parameters.map.file);
      return std::make_unique<CombinedSurface>(read(parameters.map.file),
                                               read(parameters.map.second_file));
    }

    std::unique_ptr<const Surface>
    make_original(const SurfaceParameters &parameters, MPI_Comm communicator)
    {
      switch (parameters.kind)
        {
          case SurfaceKind::self_affine:
            return std::make_unique<SelfAffineSurface>(parameters, communicator);
          case SurfaceKind::square_saddle:
            return std::make_unique<SquareSaddleSurface>(parameters);
          case SurfaceKind::triangular_peaks:
          case SurfaceKind::honeycomb_peaks:
            return std::make_unique<LatticePeaksSurface>(parameters);
          case SurfaceKind::sphere:
            return std::make_unique<SphereSurface>(parameters);
          case SurfaceKind::sine:
            return std::make_unique<SineSurface>(parameters);
          case SurfaceKind::flat:
            return std::make_unique<FlatSurface>();
          case SurfaceKind::expression:
            return std::make_unique<ExpressionSurface>(parameters);
          case SurfaceKind::file:
            return make_measured(parameters, communicator);
        }
      throw std::logic_error("make_surface() does not know this kind of surface.");
    }
  } // namespace

  std::unique_ptr<const Surface>
  make_surface(const SurfaceParameters &parameters, MPI_Comm communicator)
  {
    // The scene's Size is the box of the result; turn it back for the original.
    SurfaceParameters before_rotation = parameters;
    if (parameters.rotate)
      std::swap(before_rotation.size[0], before_rotation.size[1]);

    std::unique_ptr<const Surface> surface = make_original(before_rotation, communicator);
    if (parameters.invert)
      surface = std::make_unique<InvertedSurface>(std::move(surface));
    if (parameters.rotate)
      surface = std::make_unique<RotatedSurface>(std::move(surface));
    return surface;
  }
} // namespace strait
