#include "fabricate/job_zip.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/temporary_folder.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> unpacked(const std::string& zip) {
  std::map<std::string, std::string> files;
  archive* from = archive_read_new();
  archive_read_support_format_zip_seekable(from);
  EXPECT_EQ(archive_read_open_memory(from, zip.data(), zip.size()), ARCHIVE_OK);
  for (archive_entry* entry = nullptr; archive_read_next_header(from, &entry) == ARCHIVE_OK;) {
    std::string& bytes = files[archive_entry_pathname(entry)];
    bytes.resize(static_cast<std::size_t>(archive_entry_size(entry)));
    EXPECT_EQ(archive_read_data(from, bytes.data(), bytes.size()), static_cast<la_ssize_t>(bytes.size()));
  }
  archive_read_free(from);
  return files;
}

std::string noise(std::size_t count) {
  RandomStream random(1, "zip test");
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.bits());
  return bytes;
}

TEST(JobZip, HoldsEveryFileOfTheFolderButNothingBehindLinks) {
  const TemporaryFolder temporary("zip-test");
  const fs::path job = temporary.path() / "r1";
  std::map<std::string, std::string> files = {
      {"r1/build_sheet.json", "{}\n"}, {"r1/empty", ""}, {"r1/trays/1/slices/0000.png", noise(300'000)}};
  for (const auto& [name, bytes] : files) {
    make_folder((temporary.path() / name).parent_path());
    write_file_atomically(temporary.path() / name, bytes);
  }
  write_file_atomically(temporary.path() / "secret", "another's");
  fs::create_symlink(temporary.path() / "secret", job / "link");
  std::string zip;
  std::size_t largest = 0;
  write_zip(job, [&](std::string_view bytes) {
    largest = std::max(largest, bytes.size());
    zip += bytes;
    return true;
  });
  EXPECT_EQ(unpacked(zip), files);
  EXPECT_LE(largest, 100'000U) << "handed on in blocks";
}

TEST(JobZip, EndsWhereNobodyTakesMore) {
  const TemporaryFolder temporary("zip-test");
  write_file_atomically(temporary.path() / "a", noise(1'000'000));
  std::size_t taken = 0;
  write_zip(temporary.path(), [&](std::string_view bytes) {
    taken += bytes.size();
    return taken < 50'000;
  });
  EXPECT_LT(taken, 200'000U);
}

}  // namespace
}  // namespace nacre::fabricate
