#include "wire/lcm_types.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace nacre::wire {
namespace {

constexpr const char* kLcmFiles[] = {
#include "lcm_files.inc"
};

// ---- Reading the .lcm files ----

/// The words and signs of a .lcm file without comments.
std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
    } else if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      const std::size_t start = i;
      while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_')) ++i;
      tokens.emplace_back(text.substr(start, i - start));
    } else {
      tokens.emplace_back(1, c);
      ++i;
    }
  }
  return tokens;
}

Primitive primitive_of(std::string_view type) {
  static const std::map<std::string_view, Primitive> names = {
      {"int8_t", Primitive::int8},    {"boolean", Primitive::boolean}, {"int16_t", Primitive::int16},
      {"int32_t", Primitive::int32},  {"int64_t", Primitive::int64},   {"float", Primitive::float32},
      {"double", Primitive::float64}, {"string", Primitive::text}};
  const auto found = names.find(type);
  return found == names.end() ? Primitive::structure : found->second;
}

/// `length` of "name[length]": a number, or the name of an earlier member.
void set_length(Member& member, const std::string& length, const std::vector<Member>& earlier) {
  if (std::isdigit(static_cast<unsigned char>(length.front()))) {
    member.fixed_length = std::stoi(length);
    return;
  }
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (earlier[i].name == length) member.count_member = i;
  }
  if (member.count_member < 0) throw std::logic_error("array " + member.name + " of unknown length " + length);
}

/// Reads `package nacre; struct NAME { type name[length]; ... }`, over constants. Types of members are linked when all
/// files are read.
Struct parse_struct(const std::vector<std::string>& tokens, std::vector<std::string>& member_types) {
  const auto start = std::find(tokens.begin(), tokens.end(), "struct");
  if (tokens.end() - start < 4) throw std::logic_error("a .lcm file without a struct");
  Struct result{start[1], {}};
  for (auto token = start + 3; *token != "}";) {
    if (*token == "const") {
      token = std::find(token, tokens.end(), ";") + 1;
      continue;
    }
    Member member;
    member_types.push_back(*token++);
    member.primitive = primitive_of(member_types.back());
    member.name = *token++;
    if (*token == "[") {
      set_length(member, token[1], result.members);
      token += 3;
    }
    if (*token++ != ";") throw std::logic_error(result.name + "." + member.name + ": unexpected " + token[-1]);
    result.members.push_back(std::move(member));
  }
  return result;
}

Schema read_schema() {
  Schema schema;
  std::map<std::string, std::vector<std::string>> types;
  for (const char* file : kLcmFiles) {
    std::vector<std::string> member_types;
    Struct parsed = parse_struct(tokens_of(file), member_types);
    types[parsed.name] = std::move(member_types);
    schema.emplace(parsed.name, std::move(parsed));
  }
  for (auto& [name, structure] : schema) {
    for (std::size_t i = 0; i < structure.members.size(); ++i) {
      if (structure.members[i].primitive == Primitive::structure) {
        structure.members[i].structure = &schema.at(types[name][i]);
      }
    }
  }
  return schema;
}

}  // namespace

const Schema& message_types() {
  static const Schema instance = read_schema();
  return instance;
}

}  // namespace nacre::wire
