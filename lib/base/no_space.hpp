#pragma once
// A full disk is not bad input: the same write succeeds as soon as there is room.

#include <cerrno>
#include <string>

#include "base/result.hpp"

namespace nacre {

/// A write that failed for want of space. Unlike bad input, which must be corrected first, it may simply be retried.
class NoSpace : public InputError {
 public:
  using InputError::InputError;
};

/// Throws the sentence as NoSpace where `reason`, an errno, is a full disk or a used-up quota; else as InputError.
[[noreturn]] inline void refuse_write(const std::string& sentence, int reason) {
  if (reason == ENOSPC || reason == EDQUOT) throw NoSpace(sentence);
  throw InputError(sentence);
}

}  // namespace nacre
