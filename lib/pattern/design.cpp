#include "pattern/design.hpp"

#include <charconv>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "pattern/coupons.hpp"

namespace nacre::pattern {
namespace {

constexpr std::string_view kMixturePrefix = "mix:";

std::optional<Mixture> base_material(std::string_view name) {
  if (name == "soft") return Mixture{0.0};
  if (name == "interface") return Mixture{0.5};
  if (name == "rigid") return Mixture{1.0};
  return std::nullopt;
}

Result<Design> mixture_from_name(std::string_view name) {
  const std::string_view number = name.substr(kMixturePrefix.size());
  double fraction = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), fraction);
  const bool whole = error == std::errc{} && end == number.data() + number.size();
  if (!whole || !(fraction >= 0.0 && fraction <= 1.0)) {
    return fail("design \"{}\": expected mix:F with a rigid fraction F from 0 to 1", name);
  }
  return Design(Mixture{fraction == 0.0 ? 0.0 : fraction});  // no negative zero
}

}  // namespace

double Design::rigid_fraction() const { return layout() ? layout()->rigid_fraction() : mixture()->rigid_fraction; }

std::string Design::name() const {
  if (layout()) return key_of(*layout());
  const double fraction = mixture()->rigid_fraction;
  if (fraction == 0.0) return "soft";
  if (fraction == 0.5) return "interface";
  if (fraction == 1.0) return "rigid";
  return fmt::format("mix:{}", fraction);
}

Result<Design> design_from_name(std::string_view name) {
  if (const auto material = base_material(name)) return Design(*material);
  if (name.starts_with(kMixturePrefix)) return mixture_from_name(name);
  const Result<Layout> layout = layout_from_key(name);
  if (layout) return Design(*layout);
  const bool resembles_key = name.size() == 14 || (name.size() == 101 && name[0] == 'L');
  if (resembles_key) return tl::unexpected(layout.error());
  return fail(
      "design \"{}\": expected a key (14 hex digits, or L and 100 of them), soft, interface, rigid or mix:F, or on a "
      "command line a coupon, checkerboard:P or laminate:x|y:R:S",
      name);
}

Result<Design> design_from_word(std::string_view word) {
  const std::optional<Result<Layout>> coupon = coupon_from_name(word);
  if (!coupon) return design_from_name(word);
  if (!*coupon) return tl::unexpected(coupon->error());
  return Design(**coupon);
}

Design design_from_argument(const std::string& argument) {
  const Result<Design> named = design_from_word(argument);
  if (named) return *named;
  if (coupon_from_name(argument)) throw InputError(named.error().message);
  std::error_code ignored;
  if (!std::filesystem::exists(argument, ignored)) {
    throw InputError::format("{}; nor is there a file of that name", named.error().message);
  }
  const Result<Layout> layout = layout_from_text(read_file(argument), argument);
  if (!layout) throw InputError(layout.error().message);
  return Design(*layout);
}

}  // namespace nacre::pattern
