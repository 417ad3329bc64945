#pragma once
// A full disk is no bad input: what failed succeeds as soon as there is room.

#include <cerrno>
#include <string>

#include "base/result.hpp"

namespace nacre {

/// A write that failed for want of space. Whoever would mend bad input before trying again may simply try this again.
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
