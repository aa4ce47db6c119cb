#include "handey/stop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "handey/errors.hpp"

namespace handey {
namespace {

thread_local StopScope* innermost = nullptr;

// Choice: longer than anything is planned, and far from where the clock's count overflows [s].
constexpr double kLongest = 1e9;

}  // namespace

CancelToken::CancelToken() : state_(std::make_shared<State>()) {}

const CancelToken& CancelToken::never() {
  static const CancelToken token;
  return token;
}

CancelToken CancelToken::after(double seconds) {
  if (!(std::isfinite(seconds) && seconds >= 0.0)) {
    throw InvalidInput("E_RANGE", "seconds", "expected a finite number, 0 or more");
  }
  const CancelToken token;
  const std::chrono::duration<double> time(std::min(seconds, kLongest));
  token.state_->deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
  return token;
}

void CancelToken::cancel() noexcept { state_->cancelled.store(true, std::memory_order_relaxed); }

bool CancelToken::is_cancelled() const noexcept {
  return state_->cancelled.load(std::memory_order_relaxed);
}

std::optional<CancelToken::Clock::time_point> CancelToken::deadline() const noexcept {
  return state_->deadline;
}

std::optional<double> CancelToken::remaining() const noexcept {
  if (!state_->deadline) return std::nullopt;
  return std::chrono::duration<double>(*state_->deadline - Clock::now()).count();
}

bool CancelToken::is_past_deadline() const noexcept {
  return state_->deadline && Clock::now() >= *state_->deadline;
}

const char* Stopped::what() const noexcept {
  return cause_ == Cause::Deadline ? "planning stopped: the deadline passed"
                                   : "planning stopped: it was cancelled";
}

StopScope::StopScope(CancelToken token, StopHooks hooks)
    : token_(std::move(token)),
      hooks_(std::move(hooks)),
      next_poll_(CancelToken::Clock::now() + hooks_.between_polls),
      outer_(innermost) {
  innermost = this;
}

StopScope::~StopScope() { innermost = outer_; }

void StopScope::look(CancelToken::Clock::time_point now) {
  if (token_.is_cancelled()) throw Stopped(Stopped::Cause::Cancelled);
  const std::optional<CancelToken::Clock::time_point>& deadline = token_.state_->deadline;
  if (deadline && now >= *deadline) throw Stopped(Stopped::Cause::Deadline);
  if (!hooks_.poll || now < next_poll_) return;
  hooks_.poll();
  next_poll_ = CancelToken::Clock::now() + hooks_.between_polls;
}

void throw_if_stopped() {
  if (innermost == nullptr) return;
  const CancelToken::Clock::time_point now = CancelToken::Clock::now();
  for (StopScope* scope = innermost; scope != nullptr; scope = scope->outer_) scope->look(now);
}

void tell_progress(const char* what, int number, int count) {
  for (StopScope* scope = innermost; scope != nullptr; scope = scope->outer_) {
    if (!scope->hooks_.progress) continue;
    const std::string text =
        std::string(what) + ' ' + std::to_string(number) + " of " + std::to_string(count);
    scope->hooks_.progress(text);
  }
}

}  // namespace handey
