#pragma once
// Errors that are expected at run time travel in Result<T>; bad input at start-up is thrown as InputError.

#include <stdexcept>
#include <string>
#include <tl/expected.hpp>

#include <fmt/format.h>

namespace nacre {

/// Why something that may fail did fail, as a sentence for a person.
struct Error {
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Builds the failed side of a Result: `return fail("J = {} at element {}", j, e);`
template <class... Args>
tl::unexpected<Error> fail(fmt::format_string<Args...> text, Args&&... args) {
  return tl::unexpected<Error>(Error{fmt::format(text, std::forward<Args>(args)...)});
}

/// Bad input from a person: a file, a key, an option. The message names the place and what was expected; mains print it
/// and exit with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  template <class... Args>
  [[nodiscard]] static InputError format(fmt::format_string<Args...> text, Args&&... args) {
    return InputError(fmt::format(text, std::forward<Args>(args)...));
  }
};

}  // namespace nacre
