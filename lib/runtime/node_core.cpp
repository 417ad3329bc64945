#include "runtime/node_core.hpp"

#include <iterator>
#include <utility>

namespace nacre::runtime {
namespace {

template <class T>
void move_behind(std::vector<T>& head, std::vector<T>& tail) {
  head.insert(head.end(), std::make_move_iterator(tail.begin()), std::make_move_iterator(tail.end()));
}

}  // namespace

void Outputs::append(Outputs&& other) {
  move_behind(messages, other.messages);
  move_behind(computes, other.computes);
  move_behind(log, other.log);
  if (refusal.empty()) refusal = std::move(other.refusal);
}

}  // namespace nacre::runtime
