// Cancel tokens, and running Python code within a scope that stops the stages it calls.
#include "handey/stop.hpp"

#include <pybind11/functional.h>

#include <cmath>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "interruptible.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace handey::bindings {
namespace {

unsigned long main_thread = 0;

void translate_stopped(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const Stopped& stopped) {
    const py::object type = py::module_::import("handey.errors").attr("Stopped");
    const bool deadline = stopped.cause() == Stopped::Cause::Deadline;
    PyErr_SetObject(type.ptr(), py::str(deadline ? "deadline" : "cancelled").ptr());
  }
}

/// Tells a Python function how far a stage is; the stage runs without the GIL.
std::function<void(const std::string&)> tell_python(const py::function& progress) {
  return [&progress](const std::string& text) {
    const py::gil_scoped_acquire acquire;
    progress(text);
  };
}

py::object run_within(const py::function& function, const std::optional<CancelToken>& cancel,
                      const std::optional<double>& deadline,
                      const std::optional<py::function>& progress) {
  StopHooks hooks;
  if (progress) hooks.progress = tell_python(*progress);
  const StopScope scope(cancel.value_or(CancelToken::never()), std::move(hooks));
  std::optional<StopScope> timed;
  if (deadline) timed.emplace(CancelToken::after(*deadline));
  return function();
}

}  // namespace

bool is_main_thread() { return PyThread_get_thread_ident() == main_thread; }

void take_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_stop(py::module_& m) {
  main_thread =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  py::register_exception_translator(&translate_stopped);
  py::class_<CancelToken>(m, "CancelToken",
                          "Asks planning to stop, from any thread. Given to `handey.plan`.")
      .def(py::init<>(), "Stops when cancelled.")
      .def_static("after", &CancelToken::after, "seconds"_a,
                  R"(A token that also stops by itself.

Args:
    seconds: from now, finite, 0 or more.

Raises:
    InvalidInput: E_RANGE.
)")
      .def("cancel", &CancelToken::cancel, "Ask for a stop; there is no way back.")
      .def_property_readonly("cancelled", &CancelToken::is_cancelled, "Was `cancel` called?")
      .def_property_readonly("remaining", &CancelToken::remaining,
                             "Until the deadline, negative after it; None without one [s].")
      .def_property_readonly("stop_requested", &CancelToken::is_stop_requested,
                             "Cancelled, or past the deadline.");
  m.def("run_within", &run_within, "function"_a, py::kw_only(), "cancel"_a = std::nullopt,
        "deadline"_a = std::nullopt, "progress"_a = std::nullopt,
        R"(Calls a function; the stages that it calls in this thread can be stopped.

Args:
    function: without arguments.
    cancel: a token that another thread may cancel.
    deadline: seconds from now after which all stops.
    progress: told how far a long stage is, as text: "window 2 of 5".

Returns:
    What the function returns.

Raises:
    Stopped: out of the stage that was stopped, through the function.
)");
  m.def("throw_if_stopped", &throw_if_stopped,
        "Raise `Stopped` if what this thread runs within is to stop.");
}

}  // namespace handey::bindings
