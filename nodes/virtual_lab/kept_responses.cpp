#include "virtual_lab/kept_responses.hpp"

#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/result.hpp"
#include "laboratory/laboratory.hpp"
#include "laboratory/laboratory_file.hpp"
#include "runtime/journal.hpp"

namespace nacre::virtual_lab {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> whole_response(const fs::path& file) try {
  auto fields = runtime::unpack(read_file(file));
  if (!fields || fields->size() != 1) return std::nullopt;
  return std::move(fields->front());
} catch (const InputError&) {
  return std::nullopt;
}

}  // namespace

runtime::WorkFunction kept(runtime::WorkFunction work, const laboratory::Truth& truth, const fs::path& folder) {
  const std::string of = fmt::format("{}\n{}", laboratory::kResponseVersion, laboratory::to_toml(truth));
  return [work = std::move(work), of, folder](const std::string& spec) {
    const fs::path file = folder / content_hash(of + spec);
    if (std::optional<std::string> known = whole_response(file)) return *std::move(known);
    std::string response = work(spec);
    try {
      make_folder(folder);
      write_file_atomically(file, runtime::pack({response}));
    } catch (const InputError&) {
      // The response is right all the same.
    }
    return response;
  };
}

}  // namespace nacre::virtual_lab
