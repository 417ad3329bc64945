#pragma once
// A row of a cache of simulations carries the hash of its values: SQLite notices broken pages, not altered values in
// them, and a wrong number in the cache would be believed for ever.

#include <cstdint>
#include <string>
#include <string_view>

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Statement.h>
#include <fmt/format.h>

#include "base/hash.hpp"

namespace nacre::store {

inline std::int64_t simulation_checksum(std::string_view key, std::string_view failure, const double (&numbers)[4],
                                        std::string_view curve) {
  return static_cast<std::int64_t>(content_hash64(
      fmt::format("{}|{}|{:a}|{:a}|{:a}|{:a}|", key, failure, numbers[0], numbers[1], numbers[2], numbers[3])
          .append(curve)));
}

inline std::string_view bytes_in(const SQLite::Column& column) {
  const void* bytes = column.getBlob();
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(column.getBytes())};
}

/// Of a row whose first columns are key, failure, four numbers, curve.
inline std::int64_t checksum_of_simulation(SQLite::Statement& row) {
  const double numbers[4] = {row.getColumn(2).getDouble(), row.getColumn(3).getDouble(), row.getColumn(4).getDouble(),
                             row.getColumn(5).getDouble()};
  return simulation_checksum(row.getColumn(0).getString(), row.getColumn(1).getString(), numbers,
                             bytes_in(row.getColumn(6)));
}

inline std::int64_t breaks_checksum(std::string_view key, std::string_view pairs) {
  return static_cast<std::int64_t>(content_hash64(fmt::format("{}|", key).append(pairs)));
}

}  // namespace nacre::store
