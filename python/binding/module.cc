// SPDX-License-Identifier: GPL-2.0-or-later
// The module strait._core. The types that users see are also in strait/_core.pyi.
#include <strait/base/build_info.h>
#include <strait/base/exceptions.h>

#include "bindings.h"

namespace strait::python
{
  PYBIND11_MODULE(_core, module)
  {
    module.doc()               = "The compiled part of the package strait.";
    module.attr("__version__") = version;

    // With the messages of the program, which ends with status 2 or 1 on these errors.
    py::register_exception<InputError>(module, "SceneError", PyExc_ValueError).doc() =
      "A bad scene, input file or argument: one sentence that says what to do.";
    py::register_exception<ComputationError>(module, "NotConverged", PyExc_RuntimeError)
      .doc() = "A computation that could not be completed although the input is valid.";
    py::register_exception_translator([](std::exception_ptr exception) {
      try
        {
          if (exception)
            std::rethrow_exception(exception);
        }
      catch (const Interruption &stop)
        {
          PyErr_SetString(PyExc_KeyboardInterrupt, stop.what());
        }
    });
    bind_scene(module);
    bind_states(module);
    bind_seal(module);
  }
} // namespace strait::python
