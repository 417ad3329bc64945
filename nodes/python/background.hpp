#pragma once
// Long work for Python: on threads without the GIL, while the calling thread tells progress and looks for Ctrl-C.

#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <pybind11/pybind11.h>

namespace nacre::python {

/// Ends work that Python has stopped; the caller never sees it, but the reason why.
class Stopped : public std::exception {};

/// Between work and the thread that waits for it.
class Watch {
 public:
  /// From any thread of the work: the share done, 0..1, and the present step. Throws Stopped once it is to end.
  void report(double share, std::string_view step);
  /// From any thread of the work: one more of `all` is done, of the same step.
  void count(int all, std::string_view step);
  void stop();
  /// With the GIL held: hands what is new to `progress(share, step)`, unless that is None. Throws what it raises, and
  /// KeyboardInterrupt.
  void attend(const pybind11::object& progress);

 private:
  struct News {
    double share;
    std::string step;
  };
  void tell(double share, std::string_view step);
  std::mutex mutex_;
  std::optional<News> news_;
  int counted_ = 0;
  bool is_stopped_ = false;
};

/// Returns work(watch), computed on another thread; `work` and its result hold nothing of Python's. After Ctrl-C, or
/// when the callback raises, work ends at its next report, and the reason is thrown.
template <class Work>
auto in_background(const pybind11::object& progress, Work work) {
  constexpr auto kLook = std::chrono::milliseconds(50);
  Watch watch;
  auto result = std::async(std::launch::async, [&] { return work(watch); });
  const auto has_ended = [&] {
    const pybind11::gil_scoped_release released;
    return result.wait_for(kLook) == std::future_status::ready;
  };
  try {
    for (bool ended = false; !ended;) {
      ended = has_ended();
      watch.attend(progress);
    }
  } catch (...) {
    watch.stop();
    const pybind11::gil_scoped_release released;
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace nacre::python
