#include "base/temporary_folder.hpp"

#include <stdlib.h>

#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/result.hpp"

namespace nacre {

TemporaryFolder::TemporaryFolder(std::string_view purpose) {
  std::string name = (std::filesystem::temp_directory_path() / fmt::format("nacre-{}-XXXXXX", purpose)).string();
  if (::mkdtemp(name.data()) == nullptr) throw InputError::format("{}: cannot be made", name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code left_behind;
  std::filesystem::remove_all(path_, left_behind);
}

}  // namespace nacre
