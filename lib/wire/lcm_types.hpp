#pragma once
// The types of the .lcm files as data.

#include <map>
#include <string>
#include <vector>

namespace nacre::wire {

enum class Primitive { int8, boolean, int16, int32, int64, float32, float64, text, structure };

struct Struct;

/// A member of a message type: one value, a fixed array, or an array whose length is an earlier member.
struct Member {
  std::string name;
  Primitive primitive = Primitive::int8;
  const Struct* structure = nullptr;  ///< of Primitive::structure
  int fixed_length = -1;              ///< -1: not a fixed array
  int count_member = -1;              ///< index of the member that holds the length; -1: none
  bool is_array() const { return fixed_length >= 0 || count_member >= 0; }
};

struct Struct {
  std::string name;
  std::vector<Member> members;
};

/// By name.
using Schema = std::map<std::string, Struct, std::less<>>;

/// All types of lcmtypes/, parsed once from the text that the library carries. A file that cannot be parsed throws
/// std::logic_error at the first call.
const Schema& message_types();

}  // namespace nacre::wire
