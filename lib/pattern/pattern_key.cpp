#include "pattern/pattern_key.hpp"

namespace nacre::pattern {

Result<Pattern> pattern_from_key(std::string_view key) {
  const Result<Layout> layout = layout_from_key(key);
  if (!layout) return tl::unexpected(layout.error());
  const std::optional<Pattern> pattern = Pattern::from_layout(*layout);
  if (!pattern) return fail("key \"{}\": expected a pattern with eightfold symmetry", key);
  return *pattern;
}

}  // namespace nacre::pattern
