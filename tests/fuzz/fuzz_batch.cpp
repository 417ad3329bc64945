// Batches of a cluster and their results.

#include "fuzz.hpp"
#include "runtime/journal.hpp"
#include "simulator_farm/batch_file.hpp"
#include "simulator_farm/slurm.hpp"
#include "simulator_farm/test_request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::string_view bytes = fuzz::text_of(data, size);
  (void)simulator_farm::read_listing(std::string(bytes));
  (void)simulator_farm::read_response(std::string(bytes));
  // With a checksum that fits, so that the fuzzer gets behind it: fields of 'length byte, bytes'.
  std::vector<std::string> fields;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    fields.emplace_back(bytes.substr(at + 1, length));
    at += 1 + length;
  }
  for (std::string& field : fields) {
    if (field.size() > 40) field = runtime::pack({field.substr(0, 8), field.substr(8, 8), field.substr(16)});
  }
  const std::string packed = runtime::pack(fields);
  (void)simulator_farm::read_batch(packed);
  (void)simulator_farm::read_batch_result(packed, "batch");
  return 0;
}
