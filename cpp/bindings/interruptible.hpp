// How stages are called from Python: without the GIL, so that other threads go on, and so that
// Ctrl-C ends them. Python itself learns of a signal only when its own code runs again; here the
// main thread asks for it while it plans, and the KeyboardInterrupt comes out of the stage.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "handey/stop.hpp"

namespace handey::bindings {

/// Is this the thread to which Python gives signals?
bool is_main_thread();
/// Raises what the signals that have arrived ask for. For threads without the GIL.
void take_signals();

/// While it lives, the GIL is free; in the main thread, signals are looked at.
class Unlock {
 public:
  Unlock() {
    if (is_main_thread()) scope_.emplace(CancelToken::never(), StopHooks{&take_signals});
  }

 private:
  pybind11::gil_scoped_release release_;
  std::optional<StopScope> scope_;
};
using Unlocked = pybind11::call_guard<Unlock>;

}  // namespace handey::bindings
