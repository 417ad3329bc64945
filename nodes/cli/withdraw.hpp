#pragma once
// Orders that are not to be made, and those that are after all: a part of nacre approve.

#include <string>
#include <vector>

#include "game/withdrawal_book.hpp"
#include "run_access.hpp"

namespace nacre::cli {

/// Withdraws orders, or gives them again: those that are open of each design, or one by its id. The revision of `said`
/// is found. Says what became of each; status 1 where something stays as it was. Throws InputError.
int change_orders(const RunAccess& run, const std::vector<std::string>& designs_or_orders, const game::Withdrawal& said,
                  double timeout_s);

}  // namespace nacre::cli
