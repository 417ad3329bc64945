// Journals and bus logs: records, torn tails, damage in the middle, packed fields.

#include "fuzz.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  (void)runtime::unpack(fuzz::text_of(data, size));
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  std::int64_t end = 0;
  fuzz::expect_input_errors_only([&] {
    runtime::LogReader reader(file.path());
    for (int damages = 0; damages < 1000;) {
      try {
        const auto record = reader.next();
        if (!record) break;
        fuzz::expect(record->offset >= end);
        end = record->offset;
        (void)runtime::unpack(record->data);
      } catch (const InputError&) {
        ++damages;
        reader.resync();
      }
    }
    const runtime::LogEnd last = reader.end();
    fuzz::expect(last.torn_bytes >= 0 && last.sound_bytes + last.torn_bytes == static_cast<std::int64_t>(size));
  });
  return 0;
}
