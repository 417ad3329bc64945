#include "simulator_farm/batch_file.hpp"

#include <cstring>
#include <span>

#include "base/hash.hpp"
#include "runtime/journal.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::simulator_farm {
namespace {

constexpr std::string_view kBatchMark = "nacre batch 1";
constexpr std::string_view kResultMark = "nacre batch result 1";

/// Numbers as they lie in memory: farm and tasks run the same program.
template <class T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <class T>
Result<std::vector<T>> values_in(std::string_view bytes) {
  if (bytes.size() % sizeof(T) != 0) return fail("{} bytes are no whole number of values", bytes.size());
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string curve_bytes(const tester::Curve& curve) {
  std::vector<double> values = curve.strain;
  values.insert(values.end(), curve.stress_pa.begin(), curve.stress_pa.end());
  return bytes_of<double>(values);
}

struct PackedBreak {
  std::int64_t element;
  double strain;
};

std::string break_bytes(const std::vector<tester::Break>& breaks) {
  std::vector<PackedBreak> packed;
  for (const tester::Break& broken : breaks) packed.push_back({broken.element, broken.strain});
  return bytes_of<PackedBreak>(packed);
}

std::string write_record(const BatchRecord& record) {
  const std::vector<double> numbers = {record.response.modulus_pa, record.response.toughness_pa,
                                       record.response.peak_stress_pa, record.response.failure_strain, record.seconds};
  std::vector<std::string> fields = {record.key, record.response.failure, bytes_of<double>(numbers),
                                     curve_bytes(record.response.curve)};
  if (record.breaks) fields.push_back(break_bytes(*record.breaks));
  return runtime::pack(fields);
}

Result<BatchRecord> read_record(const std::string& bytes) {
  const auto fields = runtime::unpack(bytes);
  if (!fields) return tl::unexpected(fields.error());
  if (fields->size() != 4 && fields->size() != 5) return fail("a record of {} fields, expected 4 or 5", fields->size());
  const auto numbers = values_in<double>((*fields)[2]);
  const auto curve = values_in<double>((*fields)[3]);
  if (!numbers || numbers->size() != 5 || !curve || curve->size() % 2 != 0) return fail("a record of wrong lengths");
  BatchRecord record;
  record.key = (*fields)[0];
  record.response.failure = (*fields)[1];
  record.response.modulus_pa = (*numbers)[0];
  record.response.toughness_pa = (*numbers)[1];
  record.response.peak_stress_pa = (*numbers)[2];
  record.response.failure_strain = (*numbers)[3];
  record.seconds = (*numbers)[4];
  const auto middle = curve->begin() + static_cast<std::ptrdiff_t>(curve->size() / 2);
  record.response.curve.strain.assign(curve->begin(), middle);
  record.response.curve.stress_pa.assign(middle, curve->end());
  if (fields->size() == 4) return record;
  const auto packed = values_in<PackedBreak>((*fields)[4]);
  if (!packed) return tl::unexpected(packed.error());
  record.breaks.emplace();
  for (const PackedBreak& broken : *packed) {
    record.breaks->push_back({static_cast<int>(broken.element), broken.strain});
  }
  return record;
}

/// Fields behind a mark and the kernel's version.
Result<std::vector<std::string>> opened(std::string_view bytes, std::string_view mark) {
  auto fields = runtime::unpack(bytes);
  if (!fields) return fields;
  if (fields->size() < 3 || (*fields)[0] != mark) return fail("this is no \"{}\"", mark);
  if ((*fields)[1] != std::to_string(tester::kKernelVersion)) {
    return fail("it is of kernel version {}, this program's is {}: the same build of nacre must stand on every machine",
                (*fields)[1], tester::kKernelVersion);
  }
  return fields;
}

}  // namespace

std::string write_batch(const Batch& batch) {
  std::vector<std::string> fields = {std::string(kBatchMark), std::to_string(tester::kKernelVersion),
                                     batch.films.string()};
  fields.insert(fields.end(), batch.specs.begin(), batch.specs.end());
  return runtime::pack(fields);
}

Result<Batch> read_batch(std::string_view bytes) {
  auto fields = opened(bytes, kBatchMark);
  if (!fields) return tl::unexpected(fields.error());
  return Batch{(*fields)[2], {fields->begin() + 3, fields->end()}};
}

std::string batch_name(std::string_view bytes) { return content_hash(bytes); }

std::string write_batch_result(std::string_view batch, const std::vector<BatchRecord>& records) {
  std::vector<std::string> fields = {std::string(kResultMark), std::to_string(tester::kKernelVersion),
                                     std::string(batch)};
  for (const BatchRecord& record : records) fields.push_back(write_record(record));
  return runtime::pack(fields);
}

Result<std::vector<BatchRecord>> read_batch_result(std::string_view bytes, std::string_view batch) {
  const auto fields = opened(bytes, kResultMark);
  if (!fields) return tl::unexpected(fields.error());
  if ((*fields)[2] != batch) return fail("it is the result of batch {}", (*fields)[2]);
  std::vector<BatchRecord> records;
  for (std::size_t i = 3; i < fields->size(); ++i) {
    auto record = read_record((*fields)[i]);
    if (!record) return tl::unexpected(record.error());
    records.push_back(*std::move(record));
  }
  return records;
}

}  // namespace nacre::simulator_farm
