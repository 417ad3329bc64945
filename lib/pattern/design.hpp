#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "base/result.hpp"
#include "pattern/layout.hpp"

namespace nacre::pattern {

/// A homogeneous material: soft (0), interface (0.5), rigid (1) or any mixture between them.
struct Mixture {
  double rigid_fraction = 0.0;
  bool operator==(const Mixture&) const = default;
};

/// What a specimen is made of: a 20 x 20 layout repeated over the specimen, or one homogeneous material.
class Design {
 public:
  Design() : content_(Mixture{}) {}
  Design(const Layout& layout) : content_(layout) {}              // NOLINT: a layout is a design
  Design(const Pattern& pattern) : content_(pattern.layout()) {}  // NOLINT
  Design(Mixture mixture) : content_(mixture) {}                  // NOLINT
  const Layout* layout() const { return std::get_if<Layout>(&content_); }
  const Mixture* mixture() const { return std::get_if<Mixture>(&content_); }
  double rigid_fraction() const;
  /// The canonical name, used in files and messages: a key, `soft`, `interface`, `rigid`, or `mix:0.65`.
  std::string name() const;
  bool operator==(const Design&) const = default;

 private:
  std::variant<Layout, Mixture> content_;
};

/// Reads a canonical name: a key of 14 hex digits, `L` + 100 hex digits, `soft`, `interface`, `rigid`, `mix:F` with
/// 0 <= F <= 1. `mix:0`, `mix:0.5` and `mix:1` are the same designs as soft, interface and rigid.
Result<Design> design_from_name(std::string_view name);

/// A canonical name, or that of a coupon (`checkerboard:2`, `laminate:x:3:2`).
Result<Design> design_from_word(std::string_view word);

/// What a person types: a canonical name, a coupon (`checkerboard:2`, `laminate:x:3:2`), or the path of a layout file.
/// Throws InputError.
Design design_from_argument(const std::string& argument);

}  // namespace nacre::pattern
