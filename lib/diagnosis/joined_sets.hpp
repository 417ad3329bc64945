#pragma once
// What hangs together: sets that share members, directly or through others.

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace nacre::diagnosis {

/// The sets, those that share a member (a batch, a piece) as one: no two of what is returned do.
template <class Member>
std::vector<std::set<Member>> joined(const std::map<int, std::set<Member>>& of_groups) {
  std::vector<std::set<Member>> sets;
  for (const auto& entry : of_groups) {
    const std::set<Member>& own = entry.second;
    std::set<Member> all = own;
    std::erase_if(sets, [&](const std::set<Member>& other) {
      const bool meets = std::ranges::any_of(other, [&](const Member& each) { return own.contains(each); });
      if (meets) all.insert(other.begin(), other.end());
      return meets;
    });
    sets.push_back(std::move(all));
  }
  return sets;
}

}  // namespace nacre::diagnosis
