#include "background.hpp"

namespace nacre::python {

namespace py = pybind11;

void Watch::tell(double share, std::string_view step) {
  if (is_stopped_) throw Stopped();
  news_ = {share, std::string(step)};
}

void Watch::report(double share, std::string_view step) {
  const std::lock_guard lock(mutex_);
  tell(share, step);
}

void Watch::count(int all, std::string_view step) {
  const std::lock_guard lock(mutex_);
  tell(++counted_ / static_cast<double>(all), step);
}

void Watch::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
}

void Watch::attend(const py::object& progress) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  std::optional<News> news;
  {
    const std::lock_guard lock(mutex_);
    news.swap(news_);
  }
  if (news && !progress.is_none()) progress(news->share, news->step);
}

}  // namespace nacre::python
