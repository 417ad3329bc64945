#pragma once

#include <filesystem>
#include <string_view>

namespace nacre {

/// A new folder in the system's place for temporary files, that nobody else can look into and that goes with this. Its
/// name says the purpose: `nacre-import-...`. Throws InputError where there can be none.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(std::string_view purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace nacre
