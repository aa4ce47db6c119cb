// When planning must end, and how far it is. A caller says so for the thread it plans in, by a
// scope: StopScope scope(token). All stages called within it look at the token in their inner
// loops and throw Stopped soon after the token is cancelled or its deadline has passed. Whoever
// opened the scope catches that; the objects passed in (checkers, models, tables) stay usable, and
// what was being made is dropped. Scopes nest: each of them can stop what is within.
// Choice: a scope and not an option of every stage, because the loops that must look lie ten calls
// deep. It is state of one thread only; without a scope a look costs one comparison and never
// stops anything, and the result of a stage that is not stopped does not depend on it.
// Not guaranteed: a bound on the time between two looks; it is meant to stay under 20 ms.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace handey {

/// Asks planners to stop, from any thread. Copies share one state.
class CancelToken {
 public:
  using Clock = std::chrono::steady_clock;

  /// Without a deadline: stops when cancelled.
  CancelToken();
  /// One and the same token, which nobody cancels: for scopes that only want hooks.
  static const CancelToken& never();
  /// @param seconds from now; then a stop is requested without anyone's doing
  /// @throws InvalidInput (E_RANGE) unless finite and 0 or more
  static CancelToken after(double seconds);

  void cancel() noexcept;
  bool is_cancelled() const noexcept;
  std::optional<Clock::time_point> deadline() const noexcept;
  /// Until the deadline, negative once it has passed; nothing without one [s].
  std::optional<double> remaining() const noexcept;
  bool is_past_deadline() const noexcept;
  bool is_stop_requested() const noexcept { return is_cancelled() || is_past_deadline(); }

 private:
  friend class StopScope;
  struct State {
    std::atomic<bool> cancelled{false};
    std::optional<Clock::time_point> deadline;
  };
  std::shared_ptr<State> state_;
};

/// Thrown by every stage that is told to stop; not an error.
class Stopped : public std::exception {
 public:
  enum class Cause { Cancelled, Deadline };
  explicit Stopped(Cause cause) : cause_(cause) {}
  Cause cause() const noexcept { return cause_; }
  const char* what() const noexcept override;

 private:
  Cause cause_;
};

/// What a scope is told while a stage runs.
struct StopHooks {
  /// Called at the first look after `between_polls`, again and again; may throw, what it throws
  /// comes out of the stage. For callers who learn only by asking that they were interrupted.
  std::function<void()> poll;
  /// Choice: to ask may cost a lock, and planning is to end within 100 ms.
  std::chrono::milliseconds between_polls{20};
  /// Told how far a long stage is: "window 2 of 5".
  std::function<void(const std::string&)> progress;
};

/// While it lives, stages called in this thread stop as the token says.
class StopScope {
 public:
  explicit StopScope(CancelToken token, StopHooks hooks = {});
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  friend void throw_if_stopped();
  friend void tell_progress(const char* what, int number, int count);
  void look(CancelToken::Clock::time_point now);

  CancelToken token_;
  StopHooks hooks_;
  CancelToken::Clock::time_point next_poll_;
  StopScope* outer_;
};

/// The look of the inner loops: about 40 ns within a scope, 1 ns without.
/// @throws Stopped if a scope of this thread is to stop; whatever a scope's `poll` throws
void throw_if_stopped();

/// Tells the scopes of this thread that `what` ("window") `number` of `count` begins.
void tell_progress(const char* what, int number, int count);

}  // namespace handey
